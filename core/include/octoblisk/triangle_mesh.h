// An indexed triangle mesh, checked once when it is made and never changed after.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk {

/// The three corners of a triangle, counter-clockwise seen from outside.
using Triangle = std::array<Vec3, 3>;

/// (b−a)×(c−a): the outward normal, of twice the triangle's area; zero for a degenerate triangle.
inline Vec3 scaledNormal(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

inline Triangle operator*(const Pose& pose, const Triangle& t) {
  return {pose * t[0], pose * t[1], pose * t[2]};
}

/// The point of a triangle closest to `point`, in double precision; of a degenerate triangle, which is a
/// segment or a point, too.
Vec3 closestPoint(const Triangle& triangle, const Vec3& point);

/// From a triangle to a point, mesh units.
inline double distance(const Triangle& triangle, const Vec3& point) {
  return (closestPoint(triangle, point) - point).norm();
}

/// Indexed triangles over double vertices.
///
/// Legal: duplicate vertices, vertices no triangle uses, degenerate triangles, open or non-manifold surfaces.
class TriangleMesh {
 public:
  using Indices = std::array<std::uint32_t, 3>;

  /// Products of three coordinates must not overflow (predicates.h), nor floats of them (clustered_octree.h).
  static constexpr double kMaxCoordinate = 1e12;

  /// Throws std::invalid_argument, naming the vertex or triangle, where there is no triangle, an index is
  /// out of range, or a coordinate is NaN, infinite or beyond ±kMaxCoordinate.
  TriangleMesh(std::vector<Vec3> vertices, std::vector<Indices> triangles);

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Indices>& triangles() const { return triangles_; }
  std::size_t triangleCount() const { return triangles_.size(); }

  Triangle triangle(std::size_t index) const {
    const Indices& corner = triangles_[index];
    return {vertices_[corner[0]], vertices_[corner[1]], vertices_[corner[2]]};
  }

  /// The bounds of all vertices.
  const Aabb& bounds() const { return bounds_; }

 private:
  std::vector<Vec3> vertices_;
  std::vector<Indices> triangles_;
  Aabb bounds_;
};

}  // namespace octoblisk
