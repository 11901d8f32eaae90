// A core mesh as Bullet's mesh interface.
#pragma once

#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::gallery {

/// Vertices and indices in Bullet's layout, and the interface to them, in several parts if there are more
/// triangles than Bullet can number in one.
class BulletMesh {
 public:
  explicit BulletMesh(const TriangleMesh& mesh, double scale = 1.0) {
    for (const Vec3& vertex : mesh.vertices()) {
      for (const double x : vertex) vertices_.push_back(static_cast<btScalar>(scale * x));
    }
    for (const auto& corners : mesh.triangles())
      indices_.insert(indices_.end(), corners.begin(), corners.end());
    view_ = std::make_unique<btTriangleIndexVertexArray>();
    for (std::size_t begin = 0; begin < mesh.triangleCount(); begin += kMaxTriangles) {
      btIndexedMesh part;
      part.m_numTriangles = static_cast<int>(std::min(kMaxTriangles, mesh.triangleCount() - begin));
      part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices_.data() + 3 * begin);
      part.m_triangleIndexStride = 3 * sizeof(int);
      part.m_numVertices = static_cast<int>(mesh.vertices().size());
      part.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices_.data());
      part.m_vertexStride = 3 * sizeof(btScalar);
      view_->addIndexedMesh(part);
    }
  }

  btTriangleIndexVertexArray* view() const { return view_.get(); }

  /// Makes the interface read the vertices of another mesh with the same triangles, which must outlive it.
  void readVerticesOf(const BulletMesh& moved) {
    for (int part = 0; part < view_->getNumSubParts(); ++part) {
      view_->getIndexedMeshArray()[part].m_vertexBase =
          reinterpret_cast<const unsigned char*>(moved.vertices_.data());
    }
  }

 private:
  static constexpr std::size_t kMaxTriangles = std::size_t{1} << 21;  // per part, for btBvhTriangleMeshShape

  std::vector<btScalar> vertices_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> view_;
};

}  // namespace octoblisk::gallery
