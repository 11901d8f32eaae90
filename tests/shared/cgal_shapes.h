// Triangles as CGAL's shapes, and its exact verdict on two of them.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <variant>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

template <typename Kernel>
typename Kernel::Point_3 pointOf(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

template <typename Kernel>
using Shape = std::variant<typename Kernel::Point_3, typename Kernel::Segment_3, typename Kernel::Triangle_3>;

/// The triangle as what it is: a point, a segment or a proper triangle.
template <typename Kernel>
Shape<Kernel> shapeOf(const Triangle& t) {
  std::array<typename Kernel::Point_3, 3> corner = {pointOf<Kernel>(t[0]), pointOf<Kernel>(t[1]),
                                                    pointOf<Kernel>(t[2])};
  if (!CGAL::collinear(corner[0], corner[1], corner[2])) {
    return typename Kernel::Triangle_3(corner[0], corner[1], corner[2]);
  }
  std::ranges::sort(corner,
                    [](const auto& p, const auto& q) { return CGAL::lexicographically_xyz_smaller(p, q); });
  if (corner[0] == corner[2]) return corner[0];
  return typename Kernel::Segment_3(corner[0], corner[2]);
}

/// Whether two triangles share a point, by predicates without rounding.
inline bool exactlyMeet(const Triangle& a, const Triangle& b) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  return std::visit([](const auto& in_a, const auto& in_b) { return CGAL::do_intersect(in_a, in_b); },
                    shapeOf<Kernel>(a), shapeOf<Kernel>(b));
}

}  // namespace octoblisk::testing
