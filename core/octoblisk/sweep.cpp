#include "octoblisk/sweep.h"

#include <cassert>

#include "octoblisk/rounding.h"

namespace octoblisk {

std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const ClusteredOctree& b, const Motion& b_in_a,
                                  double tolerance, const SweepOptions& options) {
  assert(tolerance > 0.0 && options.slack > 0.0 && options.max_steps > 0);
  const double length = b_in_a.lengthBound(b);
  const double size = sizeOf(a, b) + b_in_a.from().translation.norm() + b_in_a.centerInB().norm() + length;
  const double reached = tolerance + kDistanceRounding * size;
  TimeOfImpact impact;
  for (int step = 1;; ++step) {
    // What is farther cannot come within reach in the rest of the motion.
    const double farthest = reached + length * (1.0 - impact.fraction);
    impact.clearance =
        distance(a, b, b_in_a.at(impact.fraction), {.upper_bound = farthest, .hint = impact.pair()});
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

}  // namespace octoblisk
