#include "render/contact_sheet.h"

#include <algorithm>
#include <cstddef>
#include <thread>

#include "models/require.h"
#include "render/renderer.h"

namespace octoblisk::demos {
namespace {

constexpr int kFrameGap = 6;  // between frames, pixels

/// Copies `rows` rows and `columns` columns of an image.
void paste(const Image& image, int from_row, int rows, int columns, Image& page, int left, int top) {
  for (int row = 0; row < rows; ++row) {
    std::copy_n(&image.at(0, from_row + row), columns, &page.at(left, top + row));
  }
}

/// The text on a white page as wide as the sheet and of the usual shape, so that it is as large as on other
/// pages.
struct Words {
  Words(const Annotation& annotation, int width)
      : layout(annotation, width, width * 3 / 4), page(width, width * 3 / 4, {255, 255, 255, 255}) {
    annotate(page, annotation, layout, 1.0, "");
  }
  int above() const { return layout.sceneTop() + 2; }  // includes the line
  int below() const { return page.height - layout.sceneTop() - layout.sceneHeight() + 2; }

  Layout layout;
  Image page;
};

/// Each entry once, in the order of the frames.
std::vector<LegendEntry> legendOfAll(const std::vector<SheetFrame>& frames) {
  std::vector<LegendEntry> legend;
  for (const SheetFrame& frame : frames) {
    for (const LegendEntry& entry : frame.picture.annotation.legend) {
      if (std::ranges::find(legend, entry.text, &LegendEntry::text) == legend.end()) legend.push_back(entry);
    }
  }
  return legend;
}

}  // namespace

Image contactSheet(const std::vector<SheetFrame>& frames, const std::string& title,
                   const std::string& subtitle, int columns, int frame_width, int frame_height,
                   unsigned threads) {
  require(!frames.empty() && columns >= 1, "a contact sheet needs a frame and a column");
  require(std::min(frame_width, frame_height) >= 64 && std::max(frame_width, frame_height) <= 4096,
          "the frames of a contact sheet must be 64 to 4096 pixels wide and high");
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  const int count = static_cast<int>(frames.size()), used = std::min(columns, count);
  const int rows = (count + used - 1) / used;
  const int width = used * (frame_width + kFrameGap) - kFrameGap,
            frames_height = rows * (frame_height + kFrameGap) - kFrameGap;

  Annotation annotation;
  annotation.title = title;
  annotation.subtitle = subtitle;
  annotation.legend = legendOfAll(frames);
  const Words words(annotation, width);
  Image page(width, words.above() + frames_height + words.below(), {255, 255, 255, 255});
  paste(words.page, 0, words.above(), width, page, 0, 0);
  paste(words.page, words.page.height - words.below(), words.below(), width, page, 0,
        page.height - words.below());
  for (int f = 0; f < count; ++f) {
    const SheetFrame& frame = frames[static_cast<std::size_t>(f)];
    const int left = f % used * (frame_width + kFrameGap),
              top = words.above() + f / used * (frame_height + kFrameGap);
    Annotation caption;
    caption.subtitle = frame.caption;
    const Words of_frame(caption, width);
    const int caption_height = std::min(of_frame.above(), frame_height / 2);
    paste(of_frame.page, 0, caption_height, frame_width, page, left, top);
    const int height = frame_height - caption_height;
    paste(renderScene(frame.picture.scene, frame.picture.camera, frame_width, height,
                      static_cast<float>(words.layout.scale()), threads),
          0, height, frame_width, page, left, top + caption_height);
  }
  return page;
}

}  // namespace octoblisk::demos
