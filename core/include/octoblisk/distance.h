// How far apart two bodies are, and where.
#pragma once

#include <limits>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"

namespace octoblisk {

/// The least distance of two surfaces. Points are in A's frame.
struct Clearance {
  double distance = std::numeric_limits<double>::infinity();  ///< 0 where they meet; mesh units
  Vec3 point_on_a = Vec3::Zero();
  Vec3 point_on_b = Vec3::Zero();
  std::uint32_t triangle_a = kNoTriangle;  ///< kNoTriangle: none is nearer than the bound that was given
  std::uint32_t triangle_b = kNoTriangle;  ///< as well where B is convex

  bool found() const { return triangle_a != kNoTriangle; }
};

struct DistanceOptions {
  /// Only what is nearer than this is looked for; where nothing is found, the distance is proved to be at
  /// least this, less the tolerance, and it is what the clearance says, without triangles. Stops as soon as
  /// that is proved.
  double upper_bound = std::numeric_limits<double>::infinity();
  /// The distance may be too large by this much: > 0 ends sooner. 0: exact, to the rounding of the closest
  /// points of two triangles.
  double tolerance = 0.0;
  /// A pair thought to be near, the witness of the pose before, say: the nearer it is, the sooner the search
  /// ends. The answer does not depend on it, but for ties.
  TrianglePair hint = {};
};

/// The least distance between two meshes as surfaces: 0 exactly where `collide` finds a pair, which is then
/// named. One wholly inside the other is as far as their surfaces are. B's vertices are posed in double
/// precision. Allocates nothing.
Clearance distance(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                   const DistanceOptions& options = {});

/// The least distance between a mesh and a convex body; 0 where they meet. The hint's triangle of A counts.
/// Allocates nothing.
Clearance distance(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a,
                   const DistanceOptions& options = {});

}  // namespace octoblisk
