#include "octoblisk/triangle_mesh.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace octoblisk {

TriangleMesh::TriangleMesh(std::vector<Vec3> vertices, std::vector<Indices> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  if (triangles_.empty()) throw std::invalid_argument("the mesh has no triangles");
  vertices_.shrink_to_fit();  // readers append to them, so that up to half of their memory is unused
  triangles_.shrink_to_fit();
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    for (const double coordinate : vertices_[v]) {
      if (!(std::abs(coordinate) <= kMaxCoordinate)) {  // true for NaN
        throw std::invalid_argument("vertex " + std::to_string(v) + " has the coordinate " +
                                    std::to_string(coordinate) + "; it must be finite and at most 1e12");
      }
    }
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (const std::uint32_t index : triangles_[t]) {
      if (index >= vertices_.size()) {
        throw std::invalid_argument("triangle " + std::to_string(t) + " uses vertex " +
                                    std::to_string(index) + ", but the mesh has " +
                                    std::to_string(vertices_.size()) + " vertices");
      }
      bounds_.extend(vertices_[index]);
    }
  }
}

}  // namespace octoblisk
