#include "report/grinding_frames.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <system_error>

#include "report/grinding_pictures.h"

namespace octoblisk::demos {
namespace {

constexpr int kFrameWidth = 1280, kFrameHeight = 960;  // pixels
constexpr int kSheetScale = 2;                         // a frame is that much smaller on the sheet

/// Each pixel the mean of a square of pixels.
Image smaller(const Image& image, int scale) {
  Image small(image.width / scale, image.height / scale, {255, 255, 255, 255});
  for (int row = 0; row < small.height; ++row) {
    for (int column = 0; column < small.width; ++column) {
      for (std::size_t channel = 0; channel < 4; ++channel) {
        int sum = scale * scale / 2;
        for (int k = 0; k < scale * scale; ++k) {
          sum += image.at(scale * column + k % scale, scale * row + k / scale)[channel];
        }
        small.at(column, row)[channel] = static_cast<std::uint8_t>(sum / (scale * scale));
      }
    }
  }
  return small;
}

}  // namespace

std::vector<std::size_t> posesOfFrames(std::size_t poses, std::size_t count) {
  std::vector<std::size_t> chosen;
  count = std::min(count, poses);
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? 0 : (i * (poses - 1) + (count - 1) / 2) / (count - 1));
  }
  return chosen;
}

Image contactSheetOf(const std::vector<Image>& pictures) {
  if (pictures.empty()) throw std::invalid_argument("a contact sheet of no pictures");
  const int width = pictures.front().width, height = pictures.front().height;
  const int count = static_cast<int>(pictures.size());
  const int columns = std::max(
      1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(count) * height / std::max(1, width)))));
  Image sheet(columns * width, (count + columns - 1) / columns * height, {255, 255, 255, 255});
  for (int i = 0; i < count; ++i) {
    const Image& picture = pictures[static_cast<std::size_t>(i)];
    if (picture.width != width || picture.height != height) {
      throw std::invalid_argument("a contact sheet of pictures of several sizes");
    }
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        sheet.at(i % columns * width + column, i / columns * height + row) = picture.at(column, row);
      }
    }
  }
  return sheet;
}

void writeFrames(const GrindingRun& run, std::size_t count, const std::filesystem::path& folder,
                 WholeFiles& files) {
  std::error_code error;
  std::filesystem::create_directories(folder / "frames", error);
  if (error) throw std::runtime_error((folder / "frames").string() + ": cannot be made: " + error.message());
  const Camera camera = overviewOf(run).camera;
  std::vector<Image> small;
  for (const std::size_t pose : posesOfFrames(run.poses.size(), count)) {
    Picture picture = overviewOf(run, pose);
    picture.camera = camera;
    const Image image = render(picture, kFrameWidth, kFrameHeight);
    std::string name = std::to_string(small.size());
    name.insert(0, name.size() < 4 ? 4 - name.size() : 0, '0');
    writePng(image, files.add(folder / "frames" / (name + ".png")).string());
    small.push_back(smaller(image, kSheetScale));
  }
  writePng(contactSheetOf(small), files.add(folder / "contact_sheet.png").string());
}

}  // namespace octoblisk::demos
