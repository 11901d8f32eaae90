// The winding number of triangles around a point.
#pragma once

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// How often the triangles enclose the point: for a closed surface that faces outward, 1 inside and 0
/// outside; for one with holes, approximately that (A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust
/// inside-outside segmentation using generalized winding numbers, ACM TOG 32 (4), 2013). Ignores the triangle
/// `left_out`. O(n).
double windingNumber(const TriangleMesh& mesh, const Vec3& point, std::uint32_t left_out = kNoTriangle);

}  // namespace octoblisk::detail
