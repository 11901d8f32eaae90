#include "cmm/virtual_cmm.h"

#include <stdexcept>
#include <string>

#include "cmm/random_field.h"
#include "octoblisk/closest_point.h"

namespace octoblisk::demos {
namespace {

constexpr double kTouch = 1e-7;  // mm

/// How far above the nominal surface a ball touches; the ball comes down from `approach`.
double touchOf(const ClusteredOctree& part, const NominalPoint& point, const CmmOptions& options) {
  double above = options.approach;
  for (int steps = 0; above >= -options.approach; ++steps) {
    const Vec3 center = point.position + (options.probe_radius + above) * point.normal;
    const auto closest = closestPoint(part, center);
    if (!closest) break;
    // No surface is nearer: the ball may go as far without touching.
    const double free = closest->distance - options.probe_radius;
    if (steps == 0 && free <= 0.0) throw std::invalid_argument("starts in touch with the part");
    if (free < kTouch) return above;
    above -= free;
  }
  throw std::invalid_argument("meets nothing");
}

}  // namespace

std::vector<double> measureDeviations(const ClusteredOctree& part, std::span<const NominalPoint> points,
                                      const CmmOptions& options) {
  if (!(options.probe_radius > 0.0 && options.approach > 0.0 && options.noise >= 0.0)) {
    throw std::invalid_argument("the CMM's probe radius and approach must be above 0 mm, its noise at least 0");
  }
  RandomNumbers random(options.seed);
  std::vector<double> deviations;
  for (std::size_t k = 0; k < points.size(); ++k) {
    try {
      deviations.push_back(touchOf(part, points[k], options) + options.noise * random.normal());
    } catch (const std::invalid_argument& reason) {
      throw std::invalid_argument("the CMM's ball at point " + std::to_string(k) + " " + reason.what());
    }
  }
  return deviations;
}

}  // namespace octoblisk::demos
