#include "paper/cmm/virtual_cmm.h"

#include <optional>
#include <stdexcept>
#include <string>

#include "octoblisk/closest_point.h"
#include "paper/cmm/random_field.h"

namespace octoblisk::demos {
namespace {

constexpr double kTouch = 1e-7;  // mm

/// The height above the nominal surface at which a ball that comes down from `approach` touches, if it
/// touches.
std::optional<double> touchOf(const ClusteredOctree& part, const NominalPoint& point,
                              const CmmOptions& options) {
  constexpr int kMaxSteps = 10'000;  // needed only if the ball glances along a surface
  double above = options.approach;
  for (int step = 0; step < kMaxSteps && above >= -options.approach; ++step) {
    const Vec3 center = point.position + (options.probe_radius + above) * point.normal;
    const auto closest = closestPoint(part, center);
    if (!closest) return std::nullopt;
    // No surface is nearer, so the ball may move this far without touching.
    const double free = closest->distance - options.probe_radius;
    if (step == 0 && free <= 0.0) return std::nullopt;
    if (free < kTouch) return above;
    above -= free;
  }
  return std::nullopt;
}

}  // namespace

std::vector<double> measureDeviations(const ClusteredOctree& part, std::span<const NominalPoint> points,
                                      const CmmOptions& options) {
  if (!(options.probe_radius > 0.0 && options.approach > 0.0 && options.noise >= 0.0)) {
    throw std::invalid_argument(
        "the CMM's probe radius and approach must be above 0 mm, its noise at least 0");
  }
  RandomNumbers random(options.seed);
  std::vector<double> deviations;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto touch = touchOf(part, points[k], options);
    if (!touch) {
      throw std::invalid_argument("the CMM's ball touches at the start, or meets nothing, at point " +
                                  std::to_string(k));
    }
    deviations.push_back(*touch + options.noise * random.normal());
  }
  return deviations;
}

}  // namespace octoblisk::demos
