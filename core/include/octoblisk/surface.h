// A mesh as a surface: which triangles are connected, and which bound a solid.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

namespace detail {
class MeshFeatures;
struct SolidParts;
}  // namespace detail

/// What a triangle separates. A point is inside a solid if the winding number of the mesh, rounded, is not 0
/// (containment.h).
enum class TriangleRole : std::uint8_t {
  outward,  ///< bounds a solid, and faces out of it
  inward,   ///< bounds a solid, and faces into it
  inner,    ///< both sides are inside: other parts of the mesh overlap there. Or the triangle has no area
  sheet,    ///< both sides are outside, or a hole is near
};

/// What inside and depth queries need to know of a mesh, in addition to its tree. Vertices at equal positions
/// form one "corner", so that triangles without shared indices (STL) are connected too. Vertices that are
/// only nearly equal are not merged. Built once in O(n log n), never changed.
///
/// A mesh stays a solid if its facets are doubled, if parts of it overlap, if a corner lies on the edge of
/// another triangle (a T-junction), and where cracks are narrow compared with the triangles beside them.
/// Around holes its triangles are sheets: those that see holes of their own component in more than a quarter
/// of all directions, and those at the edge of a hole. A component is a sheet all over if its holes have more
/// than a quarter of its area. A mesh has holes if a triangle sees the gaps of its component in more than
/// 1/64 of all directions, or if these gaps lack more than 1/64 of the component's area.
class Surface {
 public:
  /// The tree must outlive the surface. `threads`: 0 for as many as the machine has; the answers do not
  /// depend on it.
  explicit Surface(const ClusteredOctree& tree, int threads = 0);
  explicit Surface(ClusteredOctree&&, int = 0) = delete;

  const ClusteredOctree& tree() const { return *tree_; }

  /// Whether the mesh bounds a solid and has no holes.
  bool isClosed() const { return closed_; }

  /// Whether the mesh is closed without defects: each edge belongs to two triangles, no triangles intersect,
  /// and none is inner or a sheet.
  bool isWhole() const { return whole_; }

  /// Whether every edge is used equally often in both directions.
  bool isOriented() const { return oriented_; }

  /// A triangle that intersects others may be inner in part. It has the role of the rest.
  TriangleRole role(std::uint32_t triangle) const {
    return roles_.empty() ? TriangleRole::outward : roles_[triangle];
  }

  // Corners are numbered from 0. Vertices that no triangle uses have no corner.
  std::size_t cornerCount() const { return star_begin_.size() - 1; }
  const std::array<std::uint32_t, 3>& corners(std::uint32_t triangle) const { return corners_[triangle]; }
  /// The triangles around a corner. A degenerate triangle occurs once for each of its corners that coincide.
  std::span<const std::uint32_t> star(std::uint32_t corner) const {
    return std::span(stars_).subspan(star_begin_[corner], star_begin_[corner + 1] - star_begin_[corner]);
  }
  const Vec3& position(std::uint32_t corner) const { return tree_->mesh().vertices()[vertex_[corner]]; }

  /// A component is a set of triangles connected by corners. One of its corners represents it.
  std::size_t componentCount() const { return component_corner_.size(); }
  std::uint32_t cornerOfComponent(std::size_t component) const { return component_corner_[component]; }
  std::uint32_t component(std::uint32_t corner) const { return component_[corner]; }

  /// The mesh without what is inside the solid: without inner triangles, copies of others, and the inner
  /// parts of triangles that intersect. The surface's own tree if it has none of these.
  const ClusteredOctree& boundary() const;
  /// The triangle that a triangle of boundary() is, or is a part of.
  std::uint32_t sourceOf(std::uint32_t boundary_triangle) const;

  /// For the library's own queries.
  const detail::SolidParts& solidParts() const { return *solid_; }

 private:
  struct OnlyConnected {};
  Surface(const ClusteredOctree& tree, OnlyConnected);
  friend class detail::MeshFeatures;
  friend struct detail::SolidParts;

  void weld();
  void gatherStars();
  void findComponents();

  const ClusteredOctree* tree_;
  bool closed_ = true;
  bool whole_ = true;
  bool oriented_ = true;
  std::vector<std::array<std::uint32_t, 3>> corners_;  // per triangle
  std::vector<std::uint32_t> vertex_;                  // per corner: one vertex at its position
  std::vector<std::uint32_t> star_begin_;
  std::vector<std::uint32_t> stars_;
  std::vector<std::uint32_t> component_;  // per corner
  std::vector<std::uint32_t> component_corner_;
  std::vector<TriangleRole> roles_;  // per triangle; empty if all are outward
  std::shared_ptr<const detail::SolidParts> solid_;
};

}  // namespace octoblisk
