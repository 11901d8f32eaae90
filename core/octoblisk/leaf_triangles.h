// The triangles of a leaf, in double precision and in the frame of a query.
#pragma once

#include <array>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

/// A leaf's triangles and their bounds; posed by the very expression that `pose * triangle` is, so that
/// verdicts equal those of brute force to the last bit.
class LeafTriangles {
 public:
  LeafTriangles(const ClusteredOctree& tree, Child leaf, const Pose* pose = nullptr)
      : ids_(tree.triangles(leaf)) {
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      triangles_[i] = tree.mesh().triangle(ids_[i]);
      if (pose) triangles_[i] = *pose * triangles_[i];
      for (const Vec3& vertex : triangles_[i]) bounds_[i].extend(vertex);
    }
  }

  std::size_t size() const { return ids_.size(); }
  const Triangle& operator[](std::size_t i) const { return triangles_[i]; }
  const Aabb& bounds(std::size_t i) const { return bounds_[i]; }
  std::uint32_t id(std::size_t i) const { return ids_[i]; }

 private:
  std::span<const std::uint32_t> ids_;
  std::array<Triangle, kLanes> triangles_;
  std::array<Aabb, kLanes> bounds_;
};

/// Calls visit(i, j) for all pairs of triangles whose bounds are within `reach` of each other along every
/// axis. Returns true as soon as visit does, else false.
template <typename Visit>
bool forEachPairWithin(const LeafTriangles& a, const LeafTriangles& b, double reach, Visit&& visit) {
  reach *= 1.0 + 1e-12;  // room for the rounding of the subtractions below
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const bool apart = (a.bounds(i).min.array() - b.bounds(j).max.array() > reach).any() ||
                         (b.bounds(j).min.array() - a.bounds(i).max.array() > reach).any();
      if (!apart && visit(i, j)) return true;
    }
  }
  return false;
}

}  // namespace octoblisk
