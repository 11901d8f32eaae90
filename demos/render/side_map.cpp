#include "render/side_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace octoblisk::demos {
namespace {

Image::Pixel pixelOf(const Color& color) {
  const auto byte = [](float value) { return static_cast<std::uint8_t>(std::lround(255.0f * value)); };
  return {byte(color.r), byte(color.g), byte(color.b), 255};
}

}  // namespace

Image sideMap(std::span<const MapCell> cells, const Annotation& annotation, int width, int height) {
  Eigen::AlignedBox2d extent;  // of arc length and height
  for (const MapCell& cell : cells) {
    const Eigen::Vector2d middle(cell.arc, cell.height), half(cell.half_width, cell.half_height);
    extent.extend(middle - half).extend(middle + half);
  }
  Image page(width, height, {255, 255, 255, 255});
  const Layout layout(annotation, width, height);
  constexpr double kUsed = 0.92;
  double unit = 1.0;  // pixels per mm
  if (!cells.empty()) {
    unit = kUsed * std::min(width / std::max(1e-9, extent.sizes().x()),
                            layout.sceneHeight() / std::max(1e-9, extent.sizes().y()));
  }
  const double left = 0.5 * width - 0.5 * unit * (extent.min().x() + extent.max().x());
  const double bottom =
      layout.sceneTop() + 0.5 * layout.sceneHeight() + 0.5 * unit * (extent.min().y() + extent.max().y());
  for (const MapCell& cell : cells) {
    const auto column = [&](double arc) {
      return std::clamp(static_cast<int>(std::lround(left + unit * arc)), 0, width);
    };
    const auto row = [&](double above) {
      return std::clamp(static_cast<int>(std::lround(bottom - unit * above)), layout.sceneTop(),
                        layout.sceneTop() + layout.sceneHeight());
    };
    const Image::Pixel pixel = pixelOf(cell.color);
    const int first = column(cell.arc - cell.half_width);
    const int last = std::max(first + 1, column(cell.arc + cell.half_width));
    const int top = row(cell.height + cell.half_height);
    const int low = std::max(top + 1, row(cell.height - cell.half_height));
    for (int y = top; y < low && y < height; ++y) {
      for (int x = first; x < last && x < width; ++x) page.at(x, y) = pixel;
    }
  }
  annotate(page, annotation, layout, unit, "");
  return page;
}

}  // namespace octoblisk::demos
