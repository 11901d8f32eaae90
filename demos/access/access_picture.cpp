#include "access/access_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "render/annotation.h"
#include "render/picture.h"

namespace octoblisk::demos {
namespace {

/// A step of the picture's colours: ranges of tilt up to so many degrees.
struct WidthStep {
  double most;
  Color color;
  const char* text;
};

/// Light to dark but for "none", which stands out.
constexpr std::array kWidthSteps = {WidthStep{-1.0, palette::kVermilion, "nowhere free"},
                                    WidthStep{10.0, {0.94f, 0.89f, 0.62f}, "up to 10° free"},
                                    WidthStep{30.0, {0.70f, 0.83f, 0.58f}, "30°"},
                                    WidthStep{60.0, {0.38f, 0.72f, 0.63f}, "60°"},
                                    WidthStep{90.0, {0.18f, 0.53f, 0.66f}, "90°"},
                                    WidthStep{1e9, {0.15f, 0.29f, 0.53f}, "more"}};

Color widthColor(const AccessRow& row) {
  return std::ranges::find_if(kWidthSteps, [&](const WidthStep& step) { return row.widest <= step.most; })
      ->color;
}

Image::Pixel pixelOf(const Color& color) {
  const auto byte = [](float value) { return static_cast<std::uint8_t>(std::lround(255.0f * value)); };
  return {byte(color.r), byte(color.g), byte(color.b), 255};
}

/// The rectangle of the unrolled side that is seen.
struct MapExtent {
  double arc_min = std::numeric_limits<double>::infinity(), arc_max = -arc_min;
  double height_min = arc_min, height_max = -arc_min;

  void extend(const AccessRow& site) {
    arc_min = std::min(arc_min, site.arc - site.half_width);
    arc_max = std::max(arc_max, site.arc + site.half_width);
    height_min = std::min(height_min, site.height - site.half_height);
    height_max = std::max(height_max, site.height + site.half_height);
  }
};

/// Points of a path have no cells: half of the way to the nearest other that is not at the same place.
double halfSpacing(std::span<const AccessRow> sites) {
  constexpr double kSamePlace = 0.05;  // mm
  constexpr double kAlone = 1.0;       // mm
  double sum = 0.0;
  std::size_t count = 0;
  for (const AccessRow& site : sites) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const AccessRow& other : sites) {
      const double way = std::hypot(site.arc - other.arc, site.height - other.height);
      if (way > kSamePlace) nearest = std::min(nearest, way);
    }
    if (!std::isfinite(nearest)) continue;
    sum += nearest;
    ++count;
  }
  return count > 0 ? 0.5 * sum / static_cast<double>(count) : kAlone;
}

}  // namespace

Image accessPicture(std::span<const AccessRow> rows, const AccessQuestion& question, int width, int height) {
  std::vector<AccessRow> sites;
  for (const AccessRow& row : rows) {
    if (std::isfinite(row.arc)) sites.push_back(row);
  }
  if (question.of_path) {
    const double half = halfSpacing(sites);
    for (AccessRow& site : sites) site.half_width = site.half_height = half;
  }
  MapExtent extent;
  for (const AccessRow& site : sites) extent.extend(site);

  Annotation annotation;
  annotation.title = "Accessibility of blade " + std::to_string(question.rules.ground_blade);
  std::ostringstream subtitle;
  subtitle << "widest free range of tilt at each point; right: arc length from the leading edge, up: height "
              "above the blade's root";
  if (question.rules.near_miss > 0.0) subtitle << "; margin " << question.rules.near_miss << " mm";
  annotation.subtitle = subtitle.str();
  for (const WidthStep& step : kWidthSteps) annotation.legend.push_back({step.color, step.text});
  annotation.length_unit = "mm";

  Image page(width, height, {255, 255, 255, 255});
  const Layout layout(annotation, width, height);
  constexpr double kUsed = 0.92;
  double unit = 1.0;  // pixels of 1 mm
  if (!sites.empty()) {
    unit = kUsed * std::min(width / std::max(1e-9, extent.arc_max - extent.arc_min),
                            layout.sceneHeight() / std::max(1e-9, extent.height_max - extent.height_min));
  }
  const double left = 0.5 * width - 0.5 * unit * (extent.arc_min + extent.arc_max);
  const double bottom =
      layout.sceneTop() + 0.5 * layout.sceneHeight() + 0.5 * unit * (extent.height_min + extent.height_max);
  for (std::size_t s = 0; s < sites.size(); ++s) {
    const AccessRow& site = sites[s];
    const auto column = [&](double arc) {
      return std::clamp(static_cast<int>(std::lround(left + unit * arc)), 0, width);
    };
    const auto row = [&](double above) {
      return std::clamp(static_cast<int>(std::lround(bottom - unit * above)), layout.sceneTop(),
                        layout.sceneTop() + layout.sceneHeight());
    };
    const Image::Pixel pixel = pixelOf(widthColor(site));
    const int first = column(site.arc - site.half_width);
    const int last = std::max(first + 1, column(site.arc + site.half_width));
    const int top = row(site.height + site.half_height);
    const int low = std::max(top + 1, row(site.height - site.half_height));
    for (int y = top; y < low && y < height; ++y) {
      for (int x = first; x < last && x < width; ++x) page.at(x, y) = pixel;
    }
  }
  annotate(page, annotation, layout, unit, "");
  return page;
}

}  // namespace octoblisk::demos
