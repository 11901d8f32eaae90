// The point of a mesh that is closest to a given point.
#pragma once

#include <limits>
#include <optional>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"

namespace octoblisk {

/// Lengths in mesh units.
struct ClosestPoint {
  Vec3 point = Vec3::Zero();  ///< on the mesh
  double distance = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoTriangle;
};

/// The point of the tree's mesh that is closest to `point`, both in the mesh's frame; none if the mesh is
/// farther away than `upper_bound`. The coordinates of `point` must be within ±TriangleMesh::kMaxCoordinate.
/// Allocates nothing.
std::optional<ClosestPoint> closestPoint(const ClusteredOctree& tree, const Vec3& point,
                                         double upper_bound = std::numeric_limits<double>::infinity());

}  // namespace octoblisk
