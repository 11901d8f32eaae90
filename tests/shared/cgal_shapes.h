// Triangles as CGAL shapes, and CGAL's exact test of two of them.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <variant>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

template <typename Kernel>
typename Kernel::Point_3 pointOf(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

template <typename Kernel>
using Shape = std::variant<typename Kernel::Point_3, typename Kernel::Segment_3, typename Kernel::Triangle_3>;

/// The triangle as a point, a segment or a proper triangle.
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

/// Whether two triangles share a point, by exact predicates.
using ExactShape = Shape<CGAL::Exact_predicates_inexact_constructions_kernel>;
inline bool exactlyMeet(const ExactShape& a, const ExactShape& b) {
  return std::visit([](const auto& in_a, const auto& in_b) { return CGAL::do_intersect(in_a, in_b); }, a, b);
}
inline bool exactlyMeet(const Triangle& a, const Triangle& b) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  return exactlyMeet(shapeOf<Kernel>(a), shapeOf<Kernel>(b));
}

/// All triangle pairs that meet, in ascending order of indices, like bruteForcePairs but without the
/// library's tests. B's vertices are posed in double precision. Compile it without fused multiply-add, like
/// the library.
inline std::vector<TrianglePair> exactPairs(const TriangleMesh& a, const TriangleMesh& b,
                                            const Pose& b_in_a) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  struct Candidate {
    Aabb bounds;
    ExactShape shape;
  };
  const auto candidateOf = [](const Triangle& triangle) {
    Candidate candidate{{}, shapeOf<Kernel>(triangle)};
    for (const Vec3& corner : triangle) candidate.bounds.extend(corner);
    return candidate;
  };
  std::vector<Candidate> posed;
  for (std::size_t j = 0; j < b.triangleCount(); ++j) posed.push_back(candidateOf(b_in_a * b.triangle(j)));
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0; i < a.triangleCount(); ++i) {
    const Candidate in_a = candidateOf(a.triangle(i));
    for (std::size_t j = 0; j < posed.size(); ++j) {
      const Aabb &box = in_a.bounds, &other = posed[j].bounds;
      if ((box.min.array() > other.max.array()).any() || (other.min.array() > box.max.array()).any())
        continue;
      if (exactlyMeet(in_a.shape, posed[j].shape))
        pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
    }
  }
  return pairs;
}

}  // namespace octoblisk::testing
