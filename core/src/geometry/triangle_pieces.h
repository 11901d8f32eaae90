// The pieces of a triangle between the triangles that intersect it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The corners of a convex piece of a triangle, in the triangle's order.
using TrianglePiece = std::vector<Vec3>;

/// The mean of its corners.
inline Vec3 middleOf(const TrianglePiece& piece) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& corner : piece) middle += corner / static_cast<double>(piece.size());
  return middle;
}

/// Whether the other triangle passes through the inside of this one, ends on it along a segment, or lies in
/// its plane and overlaps it. It does not if they only touch at points or at this one's edges, within the
/// tolerance (a length).
bool cuts(const Triangle& other, const Triangle& triangle, double tolerance);

/// Whether a segment, or a part of it, lies on the triangle. Parts shorter than 1e4 tolerances do not count.
bool liesAlong(const Triangle& triangle, const Vec3& from, const Vec3& to, double tolerance);

/// Whether two triangles with a common corner meet nowhere else, and no edge of one lies along the other. May
/// be false where `cuts` and `liesAlong` decide. Both are given by their other corners.
bool meetOnlyAt(const Vec3& corner, const std::array<Vec3, 2>& of_a, const std::array<Vec3, 2>& of_b,
                double tolerance);

/// The pieces between all triangles that cut this one. Each of them divides a piece that it cuts along its
/// plane, or along its edges if both are in one plane. None if the triangles cross each other so often that
/// this would take more than n log n time.
std::optional<std::vector<TrianglePiece>> piecesBetween(const Triangle& triangle,
                                                        std::vector<Triangle> others, double tolerance);

}  // namespace octoblisk::detail
