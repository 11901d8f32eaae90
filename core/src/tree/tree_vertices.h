// The vertices of all triangles in the order of a tree, for use eight at a time. The vertices below a box are
// a range.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "octoblisk/triangle_mesh.h"
#include "simd/box8.h"

namespace octoblisk::detail {

/// The bounds of points along three axes. The default is empty.
struct Extent {
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array3f high = Eigen::Array3f::Constant(-std::numeric_limits<float>::infinity());

  void extend(const Extent& other) {
    low = low.min(other.low);
    high = high.max(other.high);
  }
};

/// A range of a tree's triangles.
struct TriangleRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  std::uint32_t count() const { return end - begin; }
};

/// The vertices in single precision, relative to an origin.
class TreeVertices {
 public:
  TreeVertices(const TriangleMesh& mesh, std::span<const std::uint32_t> order, const Vec3& origin,
               int threads);

  /// The first vertex of a triangle.
  Eigen::Vector3f first(std::uint32_t triangle) const;

  /// The bounds of a range along the axes. Measuring from a point near the vertices keeps the rounding error
  /// small.
  Extent extent(TriangleRange range, const Eigen::Matrix3f& axes, const Eigen::Vector3f& from) const;

 private:
  std::size_t count_;                     // of vertices
  std::unique_ptr<float[]> coordinates_;  // all x, all y, all z
};

}  // namespace octoblisk::detail
