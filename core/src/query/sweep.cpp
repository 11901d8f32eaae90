#include "octoblisk/sweep.h"

#include <cassert>

#include "query/local_pose.h"

namespace octoblisk {

using namespace detail;

namespace {

/// Conservative advancement. `length`: how much the distance may change over all of the motion; `size`: of
/// the scene; `b_in_a_at`: the pose at a fraction.
template <typename PoseAt>
std::optional<TimeOfImpact> advance(const ClusteredOctree& a, const ClusteredOctree& b, double length,
                                    double size, double tolerance, const SweepOptions& options,
                                    const PoseAt& b_in_a_at) {
  assert(tolerance > 0.0 && options.slack > 0.0 && options.max_steps > 0);
  const double reached = tolerance + kDistanceRounding * size;
  TimeOfImpact impact;
  for (int step = 1;; ++step) {
    // What is farther cannot come within reach in the rest of the motion.
    const double farthest = reached + length * (1.0 - impact.fraction);
    impact.clearance =
        distance(a, b, b_in_a_at(impact.fraction), {.upper_bound = farthest, .hint = impact.pair()});
    if (!impact.clearance.found()) return std::nullopt;
    if (impact.clearance.distance <= (1.0 + options.slack) * reached) return impact;
    if (step >= options.max_steps) break;
    const double next = impact.fraction + (impact.clearance.distance - reached) / length;
    if (next >= 1.0) return std::nullopt;
    impact.fraction = next;
  }
  impact.converged = false;
  return impact;
}

}  // namespace

std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const ClusteredOctree& b, const Motion& b_in_a,
                                  double tolerance, const SweepOptions& options) {
  const double length = b_in_a.lengthBound(b);
  const double size =
      sizeOf(treeOf(a), treeOf(b)) + b_in_a.from().translation.norm() + b_in_a.centerInB().norm() + length;
  return advance(a, b, length, size, tolerance, options,
                 [&](double fraction) { return b_in_a.at(fraction); });
}

std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const ClusteredOctree& b,
                                  const Motion& a_in_world, const Motion& b_in_world, double tolerance,
                                  const SweepOptions& options) {
  const double length = relativeLengthBound(a, a_in_world, b, b_in_world);
  double size = sizeOf(treeOf(a), treeOf(b)) + length;
  for (const Motion* motion : {&a_in_world, &b_in_world}) {
    size += motion->from().translation.norm() + motion->centerInB().norm() + motion->advance().norm();
  }
  return advance(a, b, length, size, tolerance, options, [&](double fraction) {
    return a_in_world.at(fraction).inverse() * b_in_world.at(fraction);
  });
}

}  // namespace octoblisk
