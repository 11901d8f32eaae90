// Bullet's numbering of triangles: by part of the mesh and index within the part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octoblisk {

/// The source of a triangle of the shape: the part of the mesh interface and the index within it, as Bullet's
/// callbacks number them.
struct TriangleId {
  int part = 0;
  int index = 0;
};

/// The parts of a mesh, whose triangles are in sequence.
class TriangleParts {
 public:
  /// Bullet's trees store both numbers in 31 bits: 10 for the part in Bullet 3.24 (MAX_NUM_PARTS_IN_BITS), 21
  /// for the index.
  static constexpr std::size_t kMaxParts = std::size_t{1} << 10;
  static constexpr std::size_t kMaxTriangles = std::size_t{1} << 21;

  /// `begin` holds the first triangle of each part, in ascending order, starting with 0. A part may be empty.
  /// Throws std::invalid_argument if `begin` is not so, or if there are more than kMaxParts parts or more
  /// than kMaxTriangles triangles in a part.
  TriangleParts(std::vector<std::uint32_t> begin, std::size_t triangle_count);

  TriangleId id(std::uint32_t triangle) const;
  std::size_t count() const { return begin_.size() - 1; }
  /// The first triangle of a part. For part == count(), the end of the last part.
  std::uint32_t begin(std::size_t part) const { return begin_[part]; }

  bool operator==(const TriangleParts&) const = default;

 private:
  std::vector<std::uint32_t> begin_;  // and the end of the last part
};

}  // namespace octoblisk
