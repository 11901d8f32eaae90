// How Bullet numbers triangles: by part of the mesh and index within the part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octoblisk {

/// Where a triangle of the shape comes from: the part of the mesh interface and the index within it, as
/// Bullet's callbacks number them.
struct TriangleId {
  int part = 0;
  int index = 0;
};

/// The parts of a mesh whose triangles come one part after the other.
class TriangleParts {
 public:
  /// What fits into the 31 bits that Bullet's trees have for the two: 10 for the part in Bullet 3.24
  /// (MAX_NUM_PARTS_IN_BITS), 21 for the index.
  static constexpr std::size_t kMaxParts = std::size_t{1} << 10;
  static constexpr std::size_t kMaxTriangles = std::size_t{1} << 21;

  /// By the first triangle of each part, in ascending order, the first of them 0; a part may be empty.
  /// Throws std::invalid_argument where they are not so, or for more than kMaxParts parts or kMaxTriangles
  /// triangles in one.
  TriangleParts(std::vector<std::uint32_t> begin, std::size_t triangle_count);

  TriangleId id(std::uint32_t triangle) const;
  std::size_t count() const { return begin_.size() - 1; }
  /// The first triangle of a part; the last's end for the part after it.
  std::uint32_t begin(std::size_t part) const { return begin_[part]; }

  bool operator==(const TriangleParts&) const = default;

 private:
  std::vector<std::uint32_t> begin_;  // and the end of the last
};

}  // namespace octoblisk
