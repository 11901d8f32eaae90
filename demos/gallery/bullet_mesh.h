// A mesh of the core as Bullet's own mesh interface.
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::gallery {

/// Vertices and indices as Bullet reads them, and the view of them.
class BulletMesh {
 public:
  explicit BulletMesh(const TriangleMesh& mesh, double scale = 1.0) : vertices_(3 * mesh.vertices().size()) {
    move(mesh, scale);
    for (const auto& corners : mesh.triangles())
      indices_.insert(indices_.end(), corners.begin(), corners.end());
    constexpr int kIndexStride = 3 * sizeof(int);
    constexpr int kVertexStride = 3 * sizeof(btScalar);
    view_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.triangleCount()), indices_.data(), kIndexStride,
        static_cast<int>(mesh.vertices().size()), vertices_.data(), kVertexStride);
  }

  btTriangleIndexVertexArray* view() const { return view_.get(); }

  /// Moves the vertices to those of a mesh of the same triangles.
  void move(const TriangleMesh& deformed, double scale = 1.0) {
    std::size_t k = 0;
    for (const Vec3& vertex : deformed.vertices()) {
      for (const double x : vertex) vertices_[k++] = static_cast<btScalar>(scale * x);
    }
  }

 private:
  std::vector<btScalar> vertices_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> view_;
};

}  // namespace octoblisk::gallery
