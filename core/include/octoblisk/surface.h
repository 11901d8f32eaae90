// A mesh as a surface: which triangles are connected, and whether they enclose a solid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

/// What inside and depth queries need to know of a mesh, in addition to its tree. Vertices at equal positions
/// form one "corner", so that triangles without shared indices (STL) are connected too. Vertices that are
/// only nearly equal are not merged. Built once in O(n log n), never changed.
class Surface {
 public:
  /// The tree must outlive the surface.
  explicit Surface(const ClusteredOctree& tree);
  explicit Surface(ClusteredOctree&&) = delete;

  const ClusteredOctree& tree() const { return *tree_; }

  /// Whether every edge belongs to an even number of triangles. The parity of crossings then divides space
  /// into an inside and an outside, whatever the genus, the orientation, or how the surface meets itself. If
  /// a corner lies inside another triangle's edge (a T-junction), that edge is open.
  bool isClosed() const { return closed_; }

  /// Whether every edge is used equally often in both directions: closed, and consistently oriented.
  bool isOriented() const { return oriented_; }

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

 private:
  void weld();
  void gatherStars();
  void checkEdges();
  void findComponents();

  const ClusteredOctree* tree_;
  bool closed_ = true;
  bool oriented_ = true;
  std::vector<std::array<std::uint32_t, 3>> corners_;  // per triangle
  std::vector<std::uint32_t> vertex_;                  // per corner: one vertex at its position
  std::vector<std::uint32_t> star_begin_;
  std::vector<std::uint32_t> stars_;
  std::vector<std::uint32_t> component_;  // per corner
  std::vector<std::uint32_t> component_corner_;
};

}  // namespace octoblisk
