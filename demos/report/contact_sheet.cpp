#include "report/contact_sheet.h"

#include <algorithm>
#include <cstddef>
#include <thread>

#include "models/require.h"
#include "report/renderer.h"

namespace octoblisk::demos {
namespace {

constexpr int kGap = 6;  // between frames, pixels

void paste(const Image& image, int left, int top, Image& page) {
  for (int row = 0; row < image.height; ++row) {
    std::copy_n(&image.at(0, row), image.width, &page.at(left, top + row));
  }
}

/// A frame and its caption over it.
Image renderFrame(const SheetFrame& frame, int width, int height, double scale, unsigned threads) {
  const Annotation words{.subtitle = frame.caption, .length_unit = {}};
  const Layout layout(words, width, height, scale);
  Image image(width, height, {255, 255, 255, 255});
  paste(renderScene(frame.picture.scene, frame.picture.camera, width, layout.sceneHeight(),
                    static_cast<float>(scale), threads),
        0, layout.sceneTop(), image);
  annotate(image, words, layout, 1.0, "");
  return image;
}

}  // namespace

Image contactSheet(const std::vector<SheetFrame>& frames, const std::string& title,
                   const std::string& subtitle, int columns, int frame_width, int frame_height,
                   unsigned threads) {
  require(!frames.empty() && columns >= 1, "a contact sheet needs a frame and a column");
  require(std::min(frame_width, frame_height) >= 64 && std::max(frame_width, frame_height) <= 4096,
          "the frames of a contact sheet must be 64 to 4096 pixels wide and high");
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  const int used = std::min(columns, static_cast<int>(frames.size()));
  const int rows = (static_cast<int>(frames.size()) + used - 1) / used;
  const int width = used * (frame_width + kGap) - kGap, frames_height = rows * (frame_height + kGap) - kGap;

  // What the words take, whatever the height.
  const Annotation words{.title = title,
                         .subtitle = subtitle,
                         .legend = frames.front().picture.annotation.legend,
                         .length_unit = {}};
  const double scale = width / 1600.0;
  const Layout measured(words, width, 4 * frames_height, scale);
  const int height = 4 * frames_height - measured.sceneHeight() + frames_height;
  const Layout layout(words, width, height, scale);

  Image page(width, height, {255, 255, 255, 255});
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const int column = static_cast<int>(f) % used, row = static_cast<int>(f) / used;
    paste(renderFrame(frames[f], frame_width, frame_height, scale, threads), column * (frame_width + kGap),
          layout.sceneTop() + row * (frame_height + kGap), page);
  }
  annotate(page, words, layout, 1.0, "");
  return page;
}

}  // namespace octoblisk::demos
