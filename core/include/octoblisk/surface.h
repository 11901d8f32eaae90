// A mesh as a surface: which triangles hang together, and whether they enclose a solid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

/// What inside and depth queries know of a mesh beside its tree. Vertices at equal positions count as one
/// "corner", so that triangles without shared indices (STL) hang together too; nothing is welded that is not
/// equal to the last bit. Built once in O(n log n), never changed.
class Surface {
 public:
  /// The tree must outlive the surface.
  explicit Surface(const ClusteredOctree& tree);
  explicit Surface(ClusteredOctree&&) = delete;

  const ClusteredOctree& tree() const { return *tree_; }

  /// Whether every edge belongs to an even number of triangles: then space is parted into an inside and an
  /// outside by the parity of crossings, whatever the genus, the orientation, or how the surface meets
  /// itself. Where a corner lies amid another triangle's edge, that edge is open.
  bool isClosed() const { return closed_; }

  /// Whether every edge is used as often one way as the other: closed, and consistently oriented.
  bool isOriented() const { return oriented_; }

  // Corners are numbered from 0; those no triangle uses have none.
  std::size_t cornerCount() const { return star_begin_.size() - 1; }
  const std::array<std::uint32_t, 3>& corners(std::uint32_t triangle) const { return corners_[triangle]; }
  /// The triangles round a corner; a degenerate one once for each of its corners that coincide.
  std::span<const std::uint32_t> star(std::uint32_t corner) const {
    return std::span(stars_).subspan(star_begin_[corner], star_begin_[corner + 1] - star_begin_[corner]);
  }
  const Vec3& position(std::uint32_t corner) const { return tree_->mesh().vertices()[vertex_[corner]]; }

  /// Parts are what hangs together by corners; each is named by one of its corners.
  std::size_t partCount() const { return part_corner_.size(); }
  std::uint32_t cornerOfPart(std::size_t part) const { return part_corner_[part]; }
  std::uint32_t part(std::uint32_t corner) const { return part_[corner]; }

 private:
  void weld();
  void gatherStars();
  void checkEdges();
  void findParts();

  const ClusteredOctree* tree_;
  bool closed_ = true;
  bool oriented_ = true;
  std::vector<std::array<std::uint32_t, 3>> corners_;  // of each triangle
  std::vector<std::uint32_t> vertex_;                  // of each corner: one at its position
  std::vector<std::uint32_t> star_begin_;
  std::vector<std::uint32_t> stars_;
  std::vector<std::uint32_t> part_;  // of each corner
  std::vector<std::uint32_t> part_corner_;
};

}  // namespace octoblisk
