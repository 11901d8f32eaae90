#include "models/orientation.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "models/welded_surface.h"

namespace octoblisk::demos {

double enclosedVolume(const TriangleMesh& mesh) {
  const Vec3 middle = mesh.bounds().center();
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Triangle corners = mesh.triangle(t);
    volume += (corners[0] - middle).dot((corners[1] - middle).cross(corners[2] - middle)) / 6.0;
  }
  return volume;
}

TriangleMesh turned(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Indices> triangles = mesh.triangles();
  for (TriangleMesh::Indices& corners : triangles) std::swap(corners[1], corners[2]);
  return {mesh.vertices(), std::move(triangles)};
}

TriangleMesh withOneWinding(const TriangleMesh& mesh, std::size_t& turned) {
  struct Edge {
    std::uint32_t low, high, triangle;
    bool rises;  // the triangle runs from the lower vertex to the higher
  };
  struct Beside {
    std::uint32_t triangle;
    bool is_opposed;  // both use the edge in the same direction
  };
  const WeldedSurface surface(mesh);
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < surface.corners.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = surface.corners[t][k], to = surface.corners[t][(k + 1) % 3];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  }
  std::ranges::sort(edges, {}, [](const Edge& e) { return std::tuple(e.low, e.high, e.triangle); });
  std::vector<std::vector<Beside>> beside(mesh.triangleCount());
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t end = first + 1;
    while (end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high)
      ++end;
    if (end - first == 2) {
      const Edge &one = edges[first], &other = edges[first + 1];
      const bool is_opposed = one.rises == other.rises;
      beside[one.triangle].push_back({other.triangle, is_opposed});
      beside[other.triangle].push_back({one.triangle, is_opposed});
    }
    first = end;
  }
  std::vector<signed char> turn(mesh.triangleCount(), -1);  // -1: not known yet
  std::vector<std::uint32_t> part;
  turned = 0;
  for (std::uint32_t start = 0; start < turn.size(); ++start) {
    if (turn[start] >= 0) continue;
    part = {start};
    turn[start] = 0;
    std::size_t count = 0;  // of reversed triangles
    for (std::size_t next = 0; next < part.size(); ++next) {
      for (const auto& [triangle, is_opposed] : beside[part[next]]) {
        const auto wanted = static_cast<signed char>(turn[part[next]] ^ static_cast<int>(is_opposed));
        if (turn[triangle] < 0) {
          turn[triangle] = wanted;
          count += static_cast<std::size_t>(wanted);
          part.push_back(triangle);
        } else if (turn[triangle] != wanted) {
          throw std::invalid_argument(
              "its triangles cannot be oriented consistently: the surface is one-sided");
        }
      }
    }
    const bool most = 2 * count > part.size();
    if (most) {
      for (const std::uint32_t triangle : part) turn[triangle] = static_cast<signed char>(1 - turn[triangle]);
    }
    turned += most ? part.size() - count : count;
  }
  if (turned == 0) return mesh;
  std::vector<TriangleMesh::Indices> triangles = mesh.triangles();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (turn[t] == 1) std::swap(triangles[t][1], triangles[t][2]);
  }
  return {mesh.vertices(), std::move(triangles)};
}

}  // namespace octoblisk::demos
