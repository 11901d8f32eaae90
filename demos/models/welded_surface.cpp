#include "models/welded_surface.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace octoblisk::demos {

std::vector<std::uint32_t> firstAtSamePlace(std::span<const Vec3> vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    return std::array{vertices[v].x(), vertices[v].y(), vertices[v].z()};
  };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool repeats = k > 0 && key(order[k]) == key(order[k - 1]);
    first[order[k]] = repeats ? first[order[k - 1]] : order[k];
  }
  return first;
}

WeldedSurface::WeldedSurface(const TriangleMesh& source) : mesh(source), corners(source.triangles()) {
  const std::vector<Vec3>& vertices = mesh.vertices();
  const std::vector<std::uint32_t> first = firstAtSamePlace(vertices);
  for (TriangleMesh::Indices& triangle : corners) {
    const auto [a, b, c] = triangle;
    const auto [least, greatest] =
        std::minmax({radiusOf(vertices[a]), radiusOf(vertices[b]), radiusOf(vertices[c])});
    low.push_back(least);
    high.push_back(greatest);
    for (std::uint32_t& corner : triangle) corner = first[corner];
  }
  outermost.resize(corners.size());
  std::iota(outermost.begin(), outermost.end(), 0u);
  std::stable_sort(outermost.begin(), outermost.end(), [&](auto a, auto b) { return low[a] > low[b]; });
}

std::vector<std::vector<std::uint32_t>> WeldedSurface::neighbours() const {
  struct Edge {
    std::array<std::uint32_t, 2> ends;
    std::uint32_t triangle;
  };
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < corners.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(corners[t][k], corners[t][(k + 1) % 3]);
      edges.push_back({{a, b}, t});
    }
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  std::vector<std::vector<std::uint32_t>> result(corners.size());
  for (std::size_t k = 1; k < edges.size(); ++k) {
    if (edges[k].ends != edges[k - 1].ends) continue;
    result[edges[k].triangle].push_back(edges[k - 1].triangle);
    result[edges[k - 1].triangle].push_back(edges[k].triangle);
  }
  return result;
}

}  // namespace octoblisk::demos
