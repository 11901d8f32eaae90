#include "part_sweep.h"

#include <algorithm>
#include <utility>

namespace octoblisk::detail {

namespace {

/// The scale of the rounding errors of a part on its motion.
double sizeOf(const BodyPart& part) {
  const Motion& motion = part.in_world;
  return part.bounds().size() + motion.from().translation.norm() + motion.centerInB().norm() +
         motion.advance().norm();
}

std::optional<TimeOfImpact> sweepTrees(const BodyPart& a, const BodyPart& b, double tolerance,
                                       const SweepOptions& options) {
  const ClusteredOctree& tree = a.ours->tree();
  if (b.ours) return sweep(tree, b.ours->tree(), a.in_world, b.in_world, tolerance, options);
  return sweep(tree, *b.convex, a.in_world, b.in_world, tolerance, options);
}

}  // namespace

double sweepTolerance(const MovingBody& body_a, const BodyPart& a, const MovingBody& body_b,
                      const BodyPart& b, btScalar tolerance) {
  if (tolerance < 0) {
    tolerance =
        std::min(breakingThreshold(body_a.shape, a.ours), breakingThreshold(body_b.shape, b.ours)) / 4;
  }
  constexpr double kRounding = 4.0 * double(SIMD_EPSILON);
  const double least = kRounding * (sizeOf(a) + sizeOf(b));
  return std::max(double(tolerance), least) + a.margin() + b.margin();
}

std::optional<TimeOfImpact> sweepParts(const BodyPart& a, const BodyPart& b, double tolerance,
                                       const SweepOptions& of_distance) {
  SweepOptions options = of_distance;
  options.slack *= (tolerance - a.margin() - b.margin()) / tolerance;
  const bool exchanged = !a.ours;
  std::optional<TimeOfImpact> impact =
      exchanged ? sweepTrees(b, a, tolerance, options) : sweepTrees(a, b, tolerance, options);
  if (!impact) return impact;
  Clearance& clearance = impact->clearance;
  const Pose frame = (exchanged ? b : a).in_world.at(impact->fraction);
  clearance.point_on_a = frame * clearance.point_on_a;
  clearance.point_on_b = frame * clearance.point_on_b;
  if (exchanged) {
    std::swap(clearance.point_on_a, clearance.point_on_b);
    std::swap(clearance.triangle_a, clearance.triangle_b);
  }
  return impact;
}

}  // namespace octoblisk::detail
