#include "demos/surface_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace octoblisk::demos {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Edge> directedEdges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  for (const auto& corner : mesh.triangles()) {
    for (int k = 0; k < 3; ++k) edges.emplace_back(corner[k], corner[(k + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Six times the signed volume of a tetrahedron; 0 if it is only rounding.
double orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  const double volume = u.cross(v).dot(w);
  return std::abs(volume) <= 1e-12 * u.norm() * v.norm() * w.norm() ? 0.0 : volume;
}

bool properlyCrosses(const Vec3& from, const Vec3& to, const Triangle& t) {
  if (orientation(t[0], t[1], t[2], from) * orientation(t[0], t[1], t[2], to) >= 0.0) return false;
  const double side_0 = orientation(from, to, t[0], t[1]);
  const double side_1 = orientation(from, to, t[1], t[2]);
  const double side_2 = orientation(from, to, t[2], t[0]);
  return side_0 * side_1 > 0.0 && side_1 * side_2 > 0.0;
}

/// Whether an edge of the first triangle that has no vertex of the second crosses it.
bool edgeCrosses(const TriangleMesh& mesh, std::size_t first, std::size_t second) {
  const auto& others = mesh.triangles()[second];
  const auto isShared = [&](std::uint32_t v) {
    return std::find(others.begin(), others.end(), v) != others.end();
  };
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t from = mesh.triangles()[first][k];
    const std::uint32_t to = mesh.triangles()[first][(k + 1) % 3];
    if (isShared(from) || isShared(to)) continue;
    if (properlyCrosses(mesh.vertices()[from], mesh.vertices()[to], mesh.triangle(second))) return true;
  }
  return false;
}

}  // namespace

bool isWatertight(const TriangleMesh& mesh) {
  const std::vector<Edge> edges = directedEdges(mesh);
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
    return edge.first != edge.second &&
           std::binary_search(edges.begin(), edges.end(), Edge(edge.second, edge.first));
  });
}

long eulerCharacteristic(const TriangleMesh& mesh) {
  std::vector<Edge> edges = directedEdges(mesh);
  std::set<std::uint32_t> vertices;
  std::set<Edge> undirected;
  for (const auto& [from, to] : edges) {
    vertices.insert(from);
    undirected.insert(std::minmax(from, to));
  }
  return static_cast<long>(vertices.size()) - static_cast<long>(undirected.size()) +
         static_cast<long>(mesh.triangleCount());
}

std::size_t countCrossings(const TriangleMesh& mesh) {
  // Triangles are paired in the cells of a grid; a pair that meets in several cells counts in one of them.
  const double cell_size = mesh.bounds().halfExtents().maxCoeff() / 20.0;
  using Cell = std::array<int, 3>;
  std::map<Cell, std::vector<std::size_t>> grid;
  std::set<std::pair<std::size_t, std::size_t>> crossings;
  const auto cellOf = [&](const Vec3& point) {
    const Vec3 scaled = (point - mesh.bounds().min) / cell_size;
    return Cell{static_cast<int>(scaled.x()), static_cast<int>(scaled.y()), static_cast<int>(scaled.z())};
  };
  std::vector<Aabb> boxes(mesh.triangleCount());
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    boxes[t] = boundsOf(mesh.triangle(t));
    const Cell low = cellOf(boxes[t].min);
    const Cell high = cellOf(boxes[t].max);
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) grid[{x, y, z}].push_back(t);
      }
    }
  }
  for (const auto& [cell, members] : grid) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        if (!boxes[members[i]].meets(boxes[members[j]])) continue;
        if (edgeCrosses(mesh, members[i], members[j]) || edgeCrosses(mesh, members[j], members[i])) {
          crossings.emplace(members[i], members[j]);
        }
      }
    }
  }
  return crossings.size();
}

}  // namespace octoblisk::demos
