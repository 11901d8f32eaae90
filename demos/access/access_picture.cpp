#include "access/access_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "render/annotation.h"
#include "render/picture.h"
#include "render/side_map.h"

namespace octoblisk::demos {
namespace {

/// A step of the picture's colour scale: ranges of tilt up to this width in degrees.
struct WidthStep {
  double most;
  Color color;
  const char* text;
};

/// From light to dark; only "none" has a contrasting colour.
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

/// Points of a path have no cells: half of the distance to the nearest point at another place.
double halfSpacing(std::span<const AccessRow> sites) {
  constexpr double kSamePlace = 0.05;  // mm
  constexpr double kAlone = 1.0;       // mm
  double sum = 0.0;
  std::size_t count = 0;
  for (const AccessRow& site : sites) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const AccessRow& other : sites) {
      const double distance = std::hypot(site.arc - other.arc, site.height - other.height);
      if (distance > kSamePlace) nearest = std::min(nearest, distance);
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
  Annotation annotation;
  annotation.title = "Accessibility of blade " + std::to_string(question.rules.ground_blade);
  std::ostringstream subtitle;
  subtitle << "widest free range of tilt at each point; horizontal: arc length from the leading edge, "
              "vertical: height above the blade's root";
  if (question.rules.near_miss > 0.0) subtitle << "; margin " << question.rules.near_miss << " mm";
  annotation.subtitle = subtitle.str();
  for (const WidthStep& step : kWidthSteps) annotation.legend.push_back({step.color, step.text});
  annotation.length_unit = "mm";

  std::vector<MapCell> cells;
  for (const AccessRow& site : sites) {
    cells.push_back({site.arc, site.height, site.half_width, site.half_height, widthColor(site)});
  }
  return sideMap(cells, annotation, width, height);
}

}  // namespace octoblisk::demos
