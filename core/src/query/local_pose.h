// Poses and boxes in the local frames of trees, with bounds of the rounding in single precision.
#pragma once

#include <algorithm>

#include "base/rounding.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// The lengths that determine the rounding of distances between two trees, without those of poses.
inline double sizeOf(const Tree& a, const Tree& b) {
  return a.origin().norm() + a.radius() + b.origin().norm() + b.radius();
}

/// Only the empty boxes of a node are beyond this distance. Reaches are limited to it, so that empty boxes
/// are never entered.
inline constexpr double kFarthest = 1e29;

/// The gap up to which boxes may be within `reach` of each other, if the sizes of the bodies sum to `size`.
inline float traversalLimit(double reach, double size) {
  return static_cast<float>(std::min(kFarthest, reach + kSingleRounding * (size + reach)));
}

/// The pose of tree B in tree A, between their local frames.
struct LocalPose {
  Pose exact;  ///< of B in A
  PoseF b_to_a, a_to_b;
  double size;     ///< of both trees and their distance; determines the rounding in single precision
  double doubles;  ///< rounding error of posed vertices in double precision, for bodies far from an origin

  LocalPose(const Tree& a, const Tree& b, const Pose& b_in_a)
      : exact{b_in_a.rotation, b_in_a * b.origin() - a.origin()},
        b_to_a(exact),
        a_to_b(exact.inverse()),
        size(exact.translation.norm() + a.radius() + b.radius()),
        doubles(kDoubleRounding *
                (size + a.origin().norm() + b.origin().norm() + b_in_a.translation.norm())) {}

  float limit(double reach) const { return traversalLimit(reach + doubles, size); }
};

/// A box in a tree's local frame.
struct LocalBox {
  BoxF box;
  double size;     ///< of tree and box and their distance; determines the rounding in single precision
  double doubles;  ///< rounding error of the box in double precision, far from an origin

  LocalBox(const Tree& tree, const Obb& box_in_tree) {
    const Vec3 center = box_in_tree.center - tree.origin();
    box = {center.cast<float>(), inSinglePrecision(box_in_tree.axes), box_in_tree.half_extents.cast<float>()};
    size = center.norm() + tree.radius() + box_in_tree.half_extents.norm();
    doubles = kDoubleRounding * (size + tree.origin().norm() + box_in_tree.center.norm());
  }

  float limit(double reach) const { return traversalLimit(reach + doubles, size); }
};

}  // namespace octoblisk::detail
