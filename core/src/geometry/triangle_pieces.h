// The pieces of a triangle between the triangles that intersect it.
#pragma once

#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The corners of a convex piece of a triangle, in the triangle's order.
using TrianglePiece = std::vector<Vec3>;

/// Whether the other triangle passes through the inside of this one, ends on it along a segment, or lies in
/// its plane and overlaps it. It does not if they only touch at points or at this one's edges, within the
/// tolerance (a length).
bool cuts(const Triangle& other, const Triangle& triangle, double tolerance);

/// Whether a segment, or a part of it, lies on the triangle. Parts shorter than 1e4 tolerances do not count.
bool liesAlong(const Triangle& triangle, const Vec3& from, const Vec3& to, double tolerance);

/// Divides every piece that the other triangle cuts along the other's plane. If both are in one plane,
/// divides it along the other's edges.
void cutAlong(const Triangle& other, std::vector<TrianglePiece>& pieces, double tolerance);

}  // namespace octoblisk::detail
