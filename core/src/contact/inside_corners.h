// The corners of a mesh that are inside a solid whose surface it meets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/mesh_features.h"
#include "contact/solid_mesh.h"

namespace octoblisk::detail {

/// Walks from corner to corner: an edge of a triangle that does not meet the solid's surface stays on one
/// side of it. Only the corners from which the walk starts are located by themselves.
class InsideCorners {
 public:
  /// Finds the corners of `own` that are inside the solid `other`, among the `seeds` and those that are
  /// connected to them. The seeds include the corners of all triangles that meet the surface, at these poses
  /// to the last bit. Allocates nothing once warm.
  void find(const MeshFeatures& own, const Pose& own_in_a, const SolidMesh& other, const Pose& other_in_a,
            std::span<const std::uint32_t> seeds);

  std::span<const std::uint32_t> corners() const { return corners_; }
  bool contains(std::uint32_t corner) const { return corner < side_.size() && side_[corner] == Side::inside; }

 private:
  enum class Side : char { unknown, outside, inside };

  std::vector<Side> side_;              // per corner
  std::vector<std::uint32_t> corners_;  // those inside
  std::vector<std::uint32_t> located_;  // those whose side is known
};

}  // namespace octoblisk::detail
