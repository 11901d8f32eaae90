#include "octoblisk/sweep.h"

#include <algorithm>
#include <cassert>

#include "base/rounding.h"

namespace octoblisk {

using namespace detail;

namespace {

/// The most by which a computed distance to the body may be too large, apart from rounding.
double errorOf(const ClusteredOctree&) { return 0.0; }
double errorOf(const Convex& body) { return 2.0 * body.precision() * BodyBounds(body).size(); }

/// Conservative advancement. `length` bounds the change of the distance over the whole motion. `size` is that
/// of the scene. `b_in_a_at` gives the pose at a fraction.
template <typename Body, typename PoseAt>
std::optional<TimeOfImpact> advance(const ClusteredOctree& a, const Body& b, double length, double size,
                                    double tolerance, const SweepOptions& options, const PoseAt& b_in_a_at) {
  assert(tolerance > 0.0 && options.slack > 0.0 && options.max_steps > 0);
  assert(options.until > 0.0 && options.until <= 1.0);
  const double reached = tolerance + kDistanceRounding * size + errorOf(b);
  const double told = (1.0 + options.slack) * reached;
  TimeOfImpact impact;
  for (int step = 1;; ++step) {
    // Triangles farther away cannot come within reach in the rest of the motion, or before `until`.
    const double farthest = std::min(reached + length * (1.0 - impact.fraction),
                                     told + length * (options.until - impact.fraction));
    impact.clearance = distance(a, b, b_in_a_at(impact.fraction),
                                {.upper_bound = farthest, .hint = impact.clearance.triangles()});
    if (!impact.clearance.found()) return std::nullopt;
    if (impact.clearance.distance <= told) return impact;
    if (step >= options.max_steps) break;
    const double next = impact.fraction + (impact.clearance.distance - reached) / length;
    if (next >= options.until) return std::nullopt;
    impact.fraction = next;
  }
  impact.converged = false;
  return impact;
}

template <typename Body>
std::optional<TimeOfImpact> sweepOne(const ClusteredOctree& a, const Body& b, const Motion& b_in_a,
                                     double tolerance, const SweepOptions& options) {
  const BodyBounds bounds_a(a), bounds_b(b);
  const double length = b_in_a.lengthBound(bounds_b);
  const double size = bounds_a.size() + bounds_b.size() + b_in_a.from().translation.norm() +
                      b_in_a.centerInB().norm() + length;
  return advance(a, b, length, size, tolerance, options,
                 [&](double fraction) { return b_in_a.at(fraction); });
}

template <typename Body>
std::optional<TimeOfImpact> sweepBoth(const ClusteredOctree& a, const Body& b, const Motion& a_in_world,
                                      const Motion& b_in_world, double tolerance,
                                      const SweepOptions& options) {
  const BodyBounds bounds_a(a), bounds_b(b);
  const double length = relativeLengthBound(bounds_a, a_in_world, bounds_b, b_in_world);
  double size = bounds_a.size() + bounds_b.size() + length;
  for (const Motion* motion : {&a_in_world, &b_in_world}) {
    size += motion->from().translation.norm() + motion->centerInB().norm() + motion->advance().norm();
  }
  return advance(a, b, length, size, tolerance, options, [&](double fraction) {
    return a_in_world.at(fraction).inverse() * b_in_world.at(fraction);
  });
}

}  // namespace

std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const ClusteredOctree& b, const Motion& b_in_a,
                                  double tolerance, const SweepOptions& options) {
  return sweepOne(a, b, b_in_a, tolerance, options);
}

std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const Convex& b, const Motion& b_in_a,
                                  double tolerance, const SweepOptions& options) {
  return sweepOne(a, b, b_in_a, tolerance, options);
}

std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const ClusteredOctree& b,
                                  const Motion& a_in_world, const Motion& b_in_world, double tolerance,
                                  const SweepOptions& options) {
  return sweepBoth(a, b, a_in_world, b_in_world, tolerance, options);
}

std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const Convex& b, const Motion& a_in_world,
                                  const Motion& b_in_world, double tolerance, const SweepOptions& options) {
  return sweepBoth(a, b, a_in_world, b_in_world, tolerance, options);
}

}  // namespace octoblisk
