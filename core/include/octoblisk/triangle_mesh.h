// An indexed triangle mesh. It is checked once at construction and never changes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk {

/// The three corners of a triangle, counter-clockwise as seen from outside.
using Triangle = std::array<Vec3, 3>;

/// (b−a)×(c−a): the outward normal, as long as twice the triangle's area; zero for a degenerate triangle.
inline Vec3 scaledNormal(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

/// The outward unit normal if the area is at least 1e-150; zero for a degenerate triangle.
inline Vec3 unitNormal(const Triangle& t) { return scaledNormal(t).normalized(); }

inline Vec3 centroidOf(const Triangle& t) { return (t[0] + t[1] + t[2]) / 3.0; }

inline Triangle operator*(const Pose& pose, const Triangle& t) {
  return {pose * t[0], pose * t[1], pose * t[2]};
}

/// The point of a triangle closest to `point`, in double precision. Also works for a degenerate triangle,
/// which is a segment or a point.
Vec3 closestPoint(const Triangle& triangle, const Vec3& point);

/// The distance from a triangle to a point, mesh units.
inline double distance(const Triangle& triangle, const Vec3& point) {
  return (closestPoint(triangle, point) - point).norm();
}

/// Indexed triangles over vertices in double precision.
///
/// Duplicate vertices, unused vertices, degenerate triangles, and open or non-manifold surfaces are allowed.
class TriangleMesh {
 public:
  using Indices = std::array<std::uint32_t, 3>;

  /// Products of three coordinates must not overflow in float.
  static constexpr double kMaxCoordinate = 1e12;

  /// Throws std::invalid_argument if there is no triangle, if an index is out of range, or if a coordinate is
  /// NaN, infinite or beyond ±kMaxCoordinate. The message names the vertex or triangle.
  TriangleMesh(std::vector<Vec3> vertices, std::vector<Indices> triangles);

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Indices>& triangles() const { return triangles_; }
  std::size_t triangleCount() const { return triangles_.size(); }

  Triangle triangle(std::size_t index) const {
    const Indices& corner = triangles_[index];
    return {vertices_[corner[0]], vertices_[corner[1]], vertices_[corner[2]]};
  }

  /// The bounds of all triangles.
  const Aabb& bounds() const { return bounds_; }

 private:
  std::vector<Vec3> vertices_;
  std::vector<Indices> triangles_;
  Aabb bounds_;
};

}  // namespace octoblisk
