// What a ray meets of a mesh: the nearest triangle, whether any, or all.
//
// Watertight: the decision whether a ray meets a triangle is exact, edges and vertices included, so that no
// ray slips through between two neighbours. A triangle seen edge on, the ray in its plane, or without area is
// not met; on a closed surface its neighbours are, where the ray comes in.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"

namespace octoblisk {

/// The points origin + t · direction, 0 <= t <= t_max, in the mesh's frame. The direction may have any
/// length: from one point to another it is their difference, and t_max 1.
///
/// A ray with a NaN meets nothing, and so does one whose origin has a coordinate beyond
/// ±TriangleMesh::kMaxCoordinate, or whose direction's largest is beyond it or below kMinDirection.
struct Ray {
  static constexpr double kMinDirection = 1e-60;

  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();
  double t_max = std::numeric_limits<double>::infinity();
  bool cull_back_faces = false;  ///< passes through triangles from behind: where direction · normal > 0
};

/// Where a ray meets a triangle.
struct RayHit {
  double t = 0.0;                        ///< of the ray: point = origin + t · direction
  std::uint32_t triangle = kNoTriangle;  ///< index in the mesh
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitX();  ///< the triangle's own, unit, outward, on whichever side the ray comes from
  bool back_face = false;       ///< the ray comes from behind: direction · normal > 0
};

/// The hit of least t; of several there the triangle of lowest index. Allocates nothing.
std::optional<RayHit> closestHit(const ClusteredOctree& tree, const Ray& ray);

/// Whether there is a hit: stops at the first found. Allocates nothing.
bool anyHit(const ClusteredOctree& tree, const Ray& ray);

/// Replaces `found` by all hits, one a triangle, by ascending t, then triangle. A ray through an edge meets
/// the triangles on both sides of it. Where `found` has the room, allocates nothing.
void allHits(const ClusteredOctree& tree, const Ray& ray, std::vector<RayHit>& found);

}  // namespace octoblisk
