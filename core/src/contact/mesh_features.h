// The features of a mesh that contacts may have: its corners and its sharp edges, and what is around them.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "octoblisk/surface.h"
#include "simd/box8.h"
#include "tree/child.h"

namespace octoblisk::detail {

/// The sine of the angle within which two directions count as the same.
inline constexpr double kAlike = 0.1;

/// A convex edge between two triangles: that from a corner of one triangle to its next corner.
struct SharpEdge {
  std::uint32_t triangle : 30, corner : 2;
  std::uint32_t across;  ///< the other triangle
  float sharpness;       ///< how far the edge deviates from what its ends say, a length
};

/// Directions within an angle from an axis; by default, all directions.
struct NormalCone {
  Eigen::Vector3f axis = Eigen::Vector3f::UnitX();
  float cosine = -1.0f, sine = 0.0f;  ///< of the angle
};

/// The normals of a leaf's faces, and the directions against which others can push the corners listed with
/// them.
struct LeafCones {
  NormalCone faces, corners;
};

/// What FeatureContacts needs to know of a mesh besides its tree. Each corner and each edge is listed once,
/// with one triangle.
class MeshFeatures {
 public:
  /// The tree must outlive it.
  explicit MeshFeatures(const ClusteredOctree& tree);
  explicit MeshFeatures(ClusteredOctree&&) = delete;

  const ClusteredOctree& tree() const { return surface_.tree(); }
  const Surface& surface() const { return surface_; }

  /// The corners listed with the triangle at a place of the tree's order: bit v for its corner v.
  unsigned cornersAt(std::uint32_t place) const { return corners_at_[place]; }
  /// The edges listed with the triangles at the places [first, end) of one leaf, the sharpest first.
  std::span<const SharpEdge> edgesOfLeaf(std::uint32_t first, std::uint32_t end) const {
    return std::span(edges_).subspan(edge_begin_[first], edge_begin_[end] - edge_begin_[first]);
  }

  /// Whether no neighbour of the corner is farther out against a unit vector in the mesh's frame: whether the
  /// vector is in the cone of directions in which others can push the corner.
  bool isPushedAlong(std::uint32_t corner, const Vec3& direction) const;

  const LeafCones& conesAt(Slot slot) const { return cones_[slot.node * kLanes + slot.lane]; }

 private:
  LeafCones conesOf(std::uint32_t first, std::uint32_t end) const;

  Surface surface_;
  std::vector<std::uint8_t> corners_at_;
  std::vector<std::uint32_t> edge_begin_;  // per place
  std::vector<SharpEdge> edges_;
  std::vector<LeafCones> cones_;  // per slot
};

/// The features of one mesh, which must not change. Any number of threads may ask.
class MeshFeaturesOnFirstUse {
 public:
  const MeshFeatures& of(const ClusteredOctree& tree) {
    std::call_once(once_, [&] { features_.emplace(tree); });
    return *features_;
  }

 private:
  std::once_flag once_;
  std::optional<MeshFeatures> features_;
};

}  // namespace octoblisk::detail
