#include "shapes/sheets.h"

#include <cmath>
#include <set>
#include <utility>

#include "shapes/grid_mesh.h"

namespace octoblisk::shapes {

SharedMesh waveSheet(double half_size, double height, int segments) {
  return gridMesh(segments + 1, segments + 1, false, false, [&](int i, int j) -> Vec3 {
    const double x = half_size * (2.0 * i / segments - 1.0), y = half_size * (2.0 * j / segments - 1.0);
    return {x, y, height * std::sin(x) * std::cos(y)};
  });
}

double trayHeight(double x, double y) {
  const double squared = x * x + y * y;
  return 0.15 * std::sin(x) * std::cos(y) + 0.003 * squared * squared;
}

SharedMesh tray(double half_size, int segments) {
  const SharedMesh flat = waveSheet(half_size, 0.0, segments);
  std::vector<Vec3> vertices = flat->vertices();
  for (Vec3& vertex : vertices) vertex.z() = trayHeight(vertex.x(), vertex.y());
  return std::make_shared<const TriangleMesh>(std::move(vertices), flat->triangles());
}

SharedMesh solidBelow(const TriangleMesh& sheet, double bottom) {
  std::vector<Vec3> vertices = sheet.vertices();
  std::vector<TriangleMesh::Indices> triangles = sheet.triangles();
  const auto below = static_cast<std::uint32_t>(vertices.size());
  for (const Vec3& vertex : sheet.vertices()) vertices.emplace_back(vertex.x(), vertex.y(), bottom);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& corner : sheet.triangles()) {
    triangles.push_back({below + corner[0], below + corner[2], below + corner[1]});
    for (int k = 0; k < 3; ++k) edges.insert({corner[k], corner[(k + 1) % 3]});
  }
  for (const auto& [from, to] : edges) {
    if (edges.contains({to, from})) continue;
    triangles.push_back({to, from, below + from});
    triangles.push_back({to, below + from, below + to});
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

}  // namespace octoblisk::shapes
