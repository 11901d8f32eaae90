// The signed distance between two solids and its derivative with respect to the pose, for optimisers.
#pragma once

#include <limits>

#include "octoblisk/contact.h"
#include "octoblisk/surface.h"

namespace octoblisk {

/// The distance between two solids, or their penetration depth. Points and vectors are in A's frame.
struct SignedDistance {
  /// Positive: the least distance between the surfaces. Otherwise minus the penetration depth. The depth is
  /// the distance from the deepest point of one surface inside the other solid to that solid's surface. The
  /// greater of two depths counts: that of A in B and that of B in A.
  double distance = std::numeric_limits<double>::infinity();
  Vec3 point_on_a = Vec3::Zero();  ///< the two witness points are |distance| apart
  Vec3 point_on_b = Vec3::Zero();
  std::uint32_t triangle_a = kNoTriangle;
  std::uint32_t triangle_b = kNoTriangle;
  /// Unit vector along which a translation of B increases the distance fastest; zero if no translation
  /// changes the distance. If A and B are apart, it points from A to B.
  Vec3 normal = Vec3::Zero();
  /// The derivative with respect to a small displacement v of B: its translation becomes translation + v.
  Vec3 by_translation = Vec3::Zero();
  /// The derivative with respect to a small rotation vector w about the origin of B's frame, in A's axes: the
  /// rotation becomes exp(w) · rotation. Length per radian.
  Vec3 by_rotation = Vec3::Zero();
};

struct SignedDistanceOptions {
  /// The greatest error of the penetration depth, a length. 0 selects 1e-7 of the surfaces' sizes. Values
  /// below 1e-10 of these sizes are raised to that. The derivative is that of one point. The depth of
  /// this point may be less than the greatest depth by about ten times the tolerance. The least distance is
  /// exact.
  double tolerance = 0.0;
};

/// The signed distance at one pose. It is continuous if both surfaces are closed. An open surface counts as a
/// solid only where GougeDepth::is_known is true: away from its holes. Where that changes, the distance jumps.
/// Only the normal at distance 0 depends on the direction in which a surface faces.
///
/// The derivative is exact where one pair of features decides the distance: a corner and a face, or two
/// edges that are apart. If the deepest point lies on an edge or within a face, and several faces of the
/// solid are equally near to it, the derivative is their weighted mean, and also exact. If several pairs tie
/// (parallel faces, a corner equally near to two faces), the derivative jumps, and the function returns that
/// of the witness pair. It also jumps at distance 0 where edges cross. At distance 0 the normal is that of
/// the face that the surfaces share. This face is assumed to face outward.
///
/// Allocates memory; PathQuery answers one pose after another without allocating. Throws
/// std::invalid_argument if neither surface is closed.
SignedDistance signedDistance(const Surface& a, const Surface& b, const Pose& b_in_a,
                              const SignedDistanceOptions& options = {});

}  // namespace octoblisk
