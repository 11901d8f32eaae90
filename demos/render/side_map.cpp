#include "render/side_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octoblisk::demos {
namespace {

Image::Pixel pixelOf(const Color& color) {
  const auto byte = [](float value) { return static_cast<std::uint8_t>(std::lround(255.0f * value)); };
  return {byte(color.r), byte(color.g), byte(color.b), 255};
}

/// The visible rectangle of the unrolled side.
struct MapExtent {
  double arc_min = std::numeric_limits<double>::infinity(), arc_max = -arc_min;
  double height_min = arc_min, height_max = -arc_min;

  void extend(const MapCell& cell) {
    arc_min = std::min(arc_min, cell.arc - cell.half_width);
    arc_max = std::max(arc_max, cell.arc + cell.half_width);
    height_min = std::min(height_min, cell.height - cell.half_height);
    height_max = std::max(height_max, cell.height + cell.half_height);
  }
};

}  // namespace

Image sideMap(std::span<const MapCell> cells, const Annotation& annotation, int width, int height) {
  MapExtent extent;
  for (const MapCell& cell : cells) extent.extend(cell);
  Image page(width, height, {255, 255, 255, 255});
  const Layout layout(annotation, width, height);
  constexpr double kUsed = 0.92;
  double unit = 1.0;  // pixels per mm
  if (!cells.empty()) {
    unit = kUsed * std::min(width / std::max(1e-9, extent.arc_max - extent.arc_min),
                            layout.sceneHeight() / std::max(1e-9, extent.height_max - extent.height_min));
  }
  const double left = 0.5 * width - 0.5 * unit * (extent.arc_min + extent.arc_max);
  const double bottom =
      layout.sceneTop() + 0.5 * layout.sceneHeight() + 0.5 * unit * (extent.height_min + extent.height_max);
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
