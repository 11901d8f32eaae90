// The least distance between two bodies, and where it occurs.
#pragma once

#include <limits>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"

namespace octoblisk {

/// The least distance between two surfaces. Points are in A's frame. If the surfaces meet, both points are
/// the same point of B. Its distance from A's triangle is at most the penetration depth of the two triangles.
/// If both triangles are degenerate, the point is accurate to their width only.
struct Clearance {
  double distance = std::numeric_limits<double>::infinity();  ///< 0 if they meet; mesh units
  Vec3 point_on_a = Vec3::Zero();
  Vec3 point_on_b = Vec3::Zero();
  std::uint32_t triangle_a = kNoTriangle;  ///< kNoTriangle: nothing is nearer than the given bound
  std::uint32_t triangle_b = kNoTriangle;  ///< also kNoTriangle if B is convex

  bool found() const { return triangle_a != kNoTriangle; }
  TrianglePair triangles() const { return {triangle_a, triangle_b}; }
};

struct DistanceOptions {
  /// Searches only for distances below this bound. If nothing is nearer, the clearance holds the bound and no
  /// triangles: the distance is proved to be at least the bound less the tolerance. The search stops as soon
  /// as this is proved.
  double upper_bound = std::numeric_limits<double>::infinity();
  /// The result may exceed the least distance by this much; a value > 0 ends the search sooner. 0: exact, up
  /// to the rounding of the closest points of two triangles.
  double tolerance = 0.0;
  /// A pair of triangles that are probably near each other, e.g. the witness of the previous pose. The nearer
  /// they are, the sooner the search ends. The answer depends on the hint only if several pairs tie.
  TrianglePair hint = {};
};

/// The least distance between two meshes as surfaces. It is 0 exactly if `collide` finds a pair, and the
/// clearance then names a pair that meets. If one mesh is wholly inside the other, this is the distance
/// between their surfaces. B's vertices are posed in double precision. Allocates nothing.
Clearance distance(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                   const DistanceOptions& options = {});

/// The least distance between a mesh and a convex body; 0 if they meet. Uses only the hint's triangle of A.
/// Allocates nothing.
Clearance distance(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a,
                   const DistanceOptions& options = {});

}  // namespace octoblisk
