// Which triangles of a mesh a ray hits: the nearest one, any one, or all.
//
// Watertight: whether a ray hits a triangle is decided exactly, edges and vertices included, so no ray slips
// through between two neighbours. A ray does not hit a triangle without area or one whose plane contains the
// ray. On a closed surface, it hits the neighbours of such a triangle instead.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"

namespace octoblisk {

/// The points origin + t · direction, 0 <= t <= t_max, in the mesh's frame. The direction may have any
/// length. For a ray from one point to another, use their difference as direction and t_max = 1.
///
/// A ray hits nothing if it contains a NaN, if a coordinate of its origin or direction exceeds
/// ±TriangleMesh::kMaxCoordinate, or if all coordinates of its direction are within ±kMinDirection.
struct Ray {
  static constexpr double kMinDirection = 1e-60;

  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();
  double t_max = std::numeric_limits<double>::infinity();
  bool cull_back_faces = false;  ///< ignore triangles hit from behind, with direction · normal > 0
};

/// A hit of a ray on a triangle.
struct RayHit {
  double t = 0.0;                        ///< parameter of the ray: point = origin + t · direction
  std::uint32_t triangle = kNoTriangle;  ///< index in the mesh
  Vec3 point = Vec3::Zero();
  /// The triangle's unit outward normal, whichever side the ray comes from. If the triangle is so thin that
  /// its normal is lost to rounding, a unit vector along the ray.
  Vec3 normal = Vec3::UnitX();
  /// The ray hits the triangle from behind: direction · normal > 0 for the exact normal.
  bool back_face = false;
};

/// The hit with the least t; if several tie, the one with the lowest triangle index. Allocates nothing.
std::optional<RayHit> closestHit(const ClusteredOctree& tree, const Ray& ray);

/// Whether the ray hits anything. Stops at the first hit found. Allocates nothing.
bool anyHit(const ClusteredOctree& tree, const Ray& ray);

/// Replaces `found` with all hits, one per triangle, sorted by t and then by triangle. A ray through an edge
/// hits the triangles on both sides of it. Allocates nothing if the capacity of `found` suffices.
void allHits(const ClusteredOctree& tree, const Ray& ray, std::vector<RayHit>& found);

}  // namespace octoblisk
