// The signed distance of two solids and its derivative by the pose: for optimisers.
#pragma once

#include <limits>

#include "octoblisk/contact.h"
#include "octoblisk/surface.h"

namespace octoblisk {

/// How far apart two solids are, or how deep one is in the other. Points and vectors are in A's frame.
struct SignedDistance {
  /// Above 0: the least distance of the surfaces. Else less the penetration depth: of the deepest point of
  /// one surface inside the other solid, to that solid's surface; the greater of both ways.
  double distance = std::numeric_limits<double>::infinity();
  Vec3 point_on_a = Vec3::Zero();  ///< the witness points are |distance| apart
  Vec3 point_on_b = Vec3::Zero();
  std::uint32_t triangle_a = kNoTriangle;
  std::uint32_t triangle_b = kNoTriangle;
  /// Unit: where B is moved along it, the distance grows fastest. From A to B where they are apart.
  Vec3 normal = Vec3::Zero();
  /// The derivative by a small displacement v of B: the translation becomes translation + v.
  Vec3 by_translation = Vec3::Zero();
  /// The derivative by a small rotation vector w about the origin of B's frame, in A's axes: the rotation
  /// becomes exp(w) · rotation. Length per radian.
  Vec3 by_rotation = Vec3::Zero();
};

struct SignedDistanceOptions {
  /// The penetration depth is found to this length: a deeper point may be missed by so much. 0: 1e-7 of the
  /// sizes of the two; a length below 1e-10 of them is raised to it. The derivative belongs to the deepest
  /// point up to some ten times this. The least distance is exact.
  double tolerance = 0.0;
};

/// The signed distance at one pose. It is continuous. Each surface is closed, or nothing is inside of it; the
/// least distance does not ask which way a surface faces, and no more does the depth.
///
/// The derivative exists where one pair of features decides the distance: of a corner and a face apart or
/// inside, of two edges apart. Where the deepest point is on an edge (or amid a face) that several faces of
/// the solid are equally far from, it is their weighted mean, exact as well. Where several pairs tie
/// (parallel faces, both ways equally deep, a corner equally far from two faces), the derivative has a jump,
/// and the one of the witness is told; so it has at 0 where edges cross. At 0 the normal is that of the face
/// the surfaces share, which is taken to face outwards.
///
/// Allocates; PathQuery answers pose after pose without. Throws std::invalid_argument where neither surface
/// is closed.
SignedDistance signedDistance(const Surface& a, const Surface& b, const Pose& b_in_a,
                              const SignedDistanceOptions& options = {});

}  // namespace octoblisk
