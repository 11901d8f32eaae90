// Poses and boxes in the frames that a tree's boxes are in, with what single precision may round.
#pragma once

#include <algorithm>

#include "base/rounding.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// The lengths that set the rounding of what is measured between two trees, but for those of poses.
inline double sizeOf(const Tree& a, const Tree& b) {
  return a.origin().norm() + a.radius() + b.origin().norm() + b.radius();
}

/// Beyond it lie only the empty boxes of a node: a reach is cut off here, so that they are never entered.
inline constexpr double kFarthest = 1e29;

/// The gap up to which boxes of bodies of this summed size may be within `reach` of each other.
inline float traversalLimit(double reach, double size) {
  return static_cast<float>(std::min(kFarthest, reach + kSingleRounding * (size + reach)));
}

/// The pose of tree B in tree A, between the frames that their boxes are in.
struct LocalPose {
  Pose exact;  ///< of B in A
  PoseF b_to_a, a_to_b;
  double size;     ///< of both trees and the way between them, which sets the rounding in single precision
  double doubles;  ///< how far posed vertices may be off in double precision, of bodies far from an origin

  LocalPose(const Tree& a, const Tree& b, const Pose& b_in_a)
      : exact{b_in_a.rotation, b_in_a * b.origin() - a.origin()},
        b_to_a(exact),
        a_to_b(exact.inverse()),
        size(exact.translation.norm() + a.radius() + b.radius()),
        doubles(kDoubleRounding *
                (size + a.origin().norm() + b.origin().norm() + b_in_a.translation.norm())) {}

  float limit(double reach) const { return traversalLimit(reach + doubles, size); }
};

/// A box in a tree's local frame, and the size of tree, box and the way between them.
struct LocalBox {
  BoxF box;
  double size;

  LocalBox(const Tree& tree, const Obb& box_in_tree) {
    const Vec3 center = box_in_tree.center - tree.origin();
    box = {center.cast<float>(), inSinglePrecision(box_in_tree.axes), box_in_tree.half_extents.cast<float>()};
    size = center.norm() + tree.radius() + box_in_tree.half_extents.norm();
  }
};

}  // namespace octoblisk::detail
