#include "query/winding.h"

#include <cmath>
#include <limits>
#include <utility>

#include "base/rounding.h"
#include "geometry/half_line_crossing.h"
#include "query/ray_walk.h"
#include "tree/tree.h"

namespace octoblisk::detail {
namespace {

/// Calls visit(index, triangle), posed in A, for all triangles that the half-line from the point along +x may
/// cross, until it returns false.
template <typename Visit>
void forEachAhead(const ClusteredOctree& tree, const Vec3& point, const Pose& tree_in_a, const Visit& visit) {
  constexpr double kAll = std::numeric_limits<double>::infinity(), kStop = -1.0;
  const Ray ray{.origin = tree_in_a.inverse() * point, .direction = tree_in_a.rotation.row(0).transpose()};
  const double rounding =
      kDoubleRounding * (point.norm() + tree_in_a.translation.norm() + treeOf(tree).origin().norm());
  forEachCandidate(treeOf(tree), ray, rounding, [&](std::uint32_t triangle) {
    return visit(triangle, tree_in_a * tree.mesh().triangle(triangle)) ? kAll : kStop;
  });
}

/// A tree over triangles that share no vertices; null if there are none.
std::shared_ptr<const ClusteredOctree> treeOver(const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return nullptr;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> indices;
  for (const Triangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    indices.push_back({first, first + 1, first + 2});
  }
  auto mesh = std::make_shared<const TriangleMesh>(std::move(vertices), std::move(indices));
  return std::make_shared<const ClusteredOctree>(ClusteredOctree::build(std::move(mesh), {.threads = 1}));
}

}  // namespace

std::optional<int> crossingNumber(const ClusteredOctree& tree, const Vec3& point, const Pose& tree_in_a,
                                  std::span<const signed char> counts) {
  int number = 0;
  bool on_surface = false;
  forEachAhead(tree, point, tree_in_a, [&](std::uint32_t t, const Triangle& triangle) {
    const Crossing crossing = halfLineCrossing(point, triangle);
    const int sign = (crossing == Crossing::leaving) - (crossing == Crossing::entering);
    number += counts.empty() ? sign : sign * counts[t];
    on_surface |= crossing == Crossing::on_triangle;
    return !on_surface;
  });
  return on_surface ? std::nullopt : std::optional(number);
}

Winding::Winding(const ClusteredOctree& tree, std::vector<std::vector<Triangle>> caps,
                 std::vector<signed char> counts)
    : tree_(&tree),
      counts_(std::move(counts)),
      caps_(std::move(caps)),
      cap_tree_(treeOver(caps_.triangles())) {}

std::optional<int> Winding::closedAt(const Vec3& point, const Pose& tree_in_a) const {
  std::optional<int> number = crossingNumber(*tree_, point, tree_in_a, counts_);
  if (number && cap_tree_) {
    forEachAhead(*cap_tree_, point, tree_in_a, [&](std::uint32_t, const Triangle& triangle) {
      *number += signedCrossing(point, triangle);
      return true;
    });
  }
  return number;
}

std::optional<int> Winding::at(const Vec3& point, const Pose& tree_in_a) const {
  const std::optional<int> closed = closedAt(point, tree_in_a);
  if (!closed || !cap_tree_) return closed;
  return *closed - caps_.roundedAt(point, tree_in_a);
}

double Winding::valueAt(const Vec3& point) const {
  const std::optional<int> closed = closedAt(point);
  return closed.value_or(0) - caps_.at(point);
}

}  // namespace octoblisk::detail
