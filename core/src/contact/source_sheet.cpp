#include "contact/source_sheet.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace octoblisk::detail {
namespace {

auto key(const SourceTriangle& t) {
  const auto& [a, b, c] = t.corners;
  return std::tuple(t.part, t.index, a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z());
}

bool areEqual(const SourceTriangle& a, const SourceTriangle& b) { return key(a) == key(b); }

ClusteredOctree treeOver(const std::vector<SourceTriangle>& triangles) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> indices;
  vertices.reserve(3 * triangles.size());
  indices.reserve(triangles.size());
  for (const SourceTriangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    indices.push_back({first, first + 1, first + 2});
    vertices.insert(vertices.end(), triangle.corners.begin(), triangle.corners.end());
  }
  return ClusteredOctree::build(std::make_shared<const TriangleMesh>(std::move(vertices), std::move(indices)),
                                {.threads = 1});
}

}  // namespace

SourceSheet::Sheet::Sheet(const std::vector<SourceTriangle>& triangles)
    : tree(treeOver(triangles)), features({tree, SolidMesh::Kind::sheet}) {}

bool SourceSheet::read(const TriangleSource& source, const Aabb& box) {
  // Whole cells as large as the box: a body that moves seldom leaves the region, which depends on nothing
  // else.
  constexpr double kLeast = 1e-100;  // for a box that is a point
  const double cell = std::exp2(std::ceil(std::log2(std::max(box.halfExtents().maxCoeff(), kLeast))));
  Aabb region;
  region.min = cell * (box.min / cell).array().floor();
  region.max = cell * (box.max / cell).array().ceil();
  fresh_.clear();
  source.forEachTriangleIn(region, [&](const SourceTriangle& triangle) {
    const auto isFinite = [](const Vec3& corner) {
      return (corner.array().abs() <= TriangleMesh::kMaxCoordinate).all();
    };
    if (std::ranges::all_of(triangle.corners, isFinite) && region.meets(boundsOf(triangle.corners)))
      fresh_.push_back(triangle);
  });
  if (std::ranges::equal(fresh_, read_, areEqual)) return false;
  std::vector<SourceTriangle> sorted = fresh_;
  std::ranges::sort(sorted, {}, key);
  sorted.erase(std::unique(sorted.begin(), sorted.end(), areEqual), sorted.end());
  if (std::ranges::equal(sorted, triangles_, areEqual)) {
    read_.swap(fresh_);
    return false;
  }
  sheet_ = sorted.empty() ? nullptr : std::make_unique<const Sheet>(sorted);
  triangles_.swap(sorted);
  read_.swap(fresh_);
  return true;
}

}  // namespace octoblisk::detail
