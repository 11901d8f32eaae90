// The triangles that a moving box may meet, the first ones first.
#pragma once

#include <cstdint>
#include <type_traits>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::detail {

/// A box that moves without turning: at the fraction t, 0 <= t <= 1, it is where `start` is, moved by
/// t · motion. Without extent it is the point of a segment. Lengths in mesh units, in the mesh's frame.
struct MovingBox {
  Obb start;
  Vec3 motion = Vec3::Zero();
  /// A triangle is near within this part of its size (the half diagonal of its bounds): for callers whose
  /// own test of a triangle takes in a rim round it.
  double rim = 0.0;
};

/// A point that moves, in a cube of half extents `tolerance`. One axis lies along the motion: the box of the
/// whole motion is narrow.
MovingBox movingPoint(const Vec3& start, const Vec3& motion, double tolerance);

/// Visits a triangle with a fraction before which the box does not meet it, and returns the greatest fraction
/// that is still of interest; below 0: none.
using AlongVisitor = double (*)(void* user, std::uint32_t triangle, double first_fraction);

/// Calls the visitor for every triangle that the moving box may meet, and for few that it passes by, as long
/// as its fraction is of interest: those of earlier boxes first, by and large. Allocates nothing; numbers
/// that are not finite meet nothing.
void forEachTriangleAlong(const ClusteredOctree& tree, const MovingBox& box, double last_fraction,
                          AlongVisitor visitor, void* user);

/// The same for anything that can be called with a triangle's index and a fraction.
template <typename Visit>
void forEachTriangleAlong(const ClusteredOctree& tree, const MovingBox& box, double last_fraction,
                          Visit&& visit) {
  forEachTriangleAlong(
      tree, box, last_fraction,
      [](void* user, std::uint32_t triangle, double first_fraction) -> double {
        return (*static_cast<std::remove_reference_t<Visit>*>(user))(triangle, first_fraction);
      },
      &visit);
}

}  // namespace octoblisk::detail
