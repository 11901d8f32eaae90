#include "shapes/sheets.h"

#include <cmath>

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

}  // namespace octoblisk::shapes
