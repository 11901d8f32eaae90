#include "models/orientation.h"

#include <utility>

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

}  // namespace octoblisk::demos
