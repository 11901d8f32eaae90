// The features of a mesh that contacts may have: its corners and its sharp edges, and what is around them.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "contact/solid_mesh.h"
#include "octoblisk/contact.h"
#include "octoblisk/surface.h"
#include "simd/box8.h"
#include "tree/child.h"

namespace octoblisk::detail {

/// The sine of the angle within which two directions count as the same.
inline constexpr double kAlike = 0.1;

/// An edge that others can touch, from a corner of a triangle to its next corner: a convex edge between two
/// triangles; of a sheet, also a concave edge, which is convex from behind, and an edge of a single triangle.
struct SharpEdge {
  std::uint32_t place : 30, corner : 2;  ///< the triangle's place in the tree's order, and its corner
  std::uint32_t across;                  ///< the other triangle; kNoTriangle: none
  float sharpness;                       ///< how far the edge deviates from what its ends say, a length
};

/// Directions within an angle from an axis; by default, all directions.
struct NormalCone {
  Eigen::Vector3f axis = Eigen::Vector3f::UnitX();
  float cosine = -2.0f;  ///< of the angle; less than -1: all directions
};

/// The features listed with the triangles of a leaf.
struct LeafFeatures {
  std::uint32_t corners_begin = 0;  ///< the number of the first corner
  std::uint32_t edges_begin = 0, edges_end = 0;
  NormalCone against;  ///< the directions opposite to those in which others can push the corners
};

/// What bounds how far from each of a node's eight boxes the features below it may be in contact.
struct NodeReach {
  float lean[3][kLanes];    ///< per axis of the box: the greatest cosine between it and a face's normal
  float sharpness[kLanes];  ///< of the sharpest edge
};

/// What FeatureContacts needs to know of a mesh besides its tree. Each corner and each edge is listed once,
/// with one triangle. Corners are numbered from 0 in the order of the list: by places in the tree's order.
class MeshFeatures {
 public:
  /// Those of the boundary. What the solid refers to must outlive it.
  explicit MeshFeatures(const SolidMesh& solid);

  const SolidMesh& solid() const { return solid_; }
  const ClusteredOctree& tree() const { return solid_.boundary(); }

  bool hasSheets() const { return has_sheets_; }
  /// Whether a triangle bounds no solid, so that both its sides can be touched.
  bool isSheet(std::uint32_t triangle) const { return has_sheets_ && !solid_.boundsSolid(triangle); }

  std::size_t cornerCount() const { return vertex_.size(); }
  const Vec3& position(std::uint32_t corner) const { return tree().mesh().vertices()[vertex_[corner]]; }
  std::array<std::uint32_t, 3> cornersOf(std::uint32_t triangle) const {
    const auto& vertices = tree().mesh().triangles()[triangle];
    return {corner_[vertices[0]], corner_[vertices[1]], corner_[vertices[2]]};
  }
  /// One triangle at a corner.
  std::uint32_t triangleAt(std::uint32_t corner) const { return triangle_[corner]; }
  /// The corners to which edges lead.
  std::span<const std::uint32_t> neighboursOf(std::uint32_t corner) const {
    return std::span(neighbours_)
        .subspan(neighbours_begin_[corner], neighbours_begin_[corner + 1] - neighbours_begin_[corner]);
  }

  const LeafFeatures& of(Slot leaf) const { return leaves_[leaf.node * kLanes + leaf.lane]; }
  const NodeReach& reachOf(std::uint32_t node) const { return reaches_[node]; }
  /// The corners listed with the triangle at a place of the tree's order: bit v for its corner v.
  unsigned cornersAt(std::uint32_t place) const { return corners_at_[place]; }
  /// The sharpest first.
  std::span<const SharpEdge> edgesOf(const LeafFeatures& leaf) const {
    return std::span(edges_).subspan(leaf.edges_begin, leaf.edges_end - leaf.edges_begin);
  }
  std::uint32_t triangleOf(const SharpEdge& edge) const;

  /// Whether a unit vector in the mesh's frame is in the cone of directions in which others can push the
  /// corner: no neighbour is farther out against the vector, and it does not point out of the solid.
  bool isPushedAlong(std::uint32_t corner, const Vec3& direction) const;

  /// The neighbour that is farthest against a vector; kNoIndex if the corner is.
  std::uint32_t neighbourAgainst(std::uint32_t corner, const Vec3& direction) const;

 private:
  void listCorners(const Surface& surface);
  void listEdges(const Surface& surface);
  void gatherNeighbours(const Surface& surface, std::uint32_t corner_of_surface);
  void describeLeaves(const Surface& surface);
  void findReaches();

  SolidMesh solid_;
  bool has_sheets_;
  std::vector<std::uint32_t> corner_;            // per vertex of the mesh
  std::vector<std::uint8_t> corners_at_;         // per place
  std::vector<std::uint32_t> vertex_;            // per corner: one vertex at its position
  std::vector<std::uint32_t> triangle_;          // per corner: the one with which it is listed
  std::vector<std::uint32_t> neighbours_begin_;  // per corner
  std::vector<std::uint32_t> neighbours_;
  std::vector<Eigen::Vector3f> normals_;  // per corner: the mean normal of its triangles; zero at sheets
  std::vector<SharpEdge> edges_;
  std::vector<NodeReach> reaches_;    // per node
  std::vector<LeafFeatures> leaves_;  // per slot
};

/// The features of one mesh, which must not change. Any number of threads may ask.
class MeshFeaturesOnFirstUse {
 public:
  const MeshFeatures& of(const SolidMesh& solid) {
    std::call_once(once_, [&] { features_.emplace(solid); });
    return *features_;
  }

 private:
  std::once_flag once_;
  std::optional<MeshFeatures> features_;
};

}  // namespace octoblisk::detail
