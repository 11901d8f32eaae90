// Owns the shapes of a world.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "dynamics/solid.h"
#include "gallery/bullet_mesh.h"

class btCollisionShape;

namespace octoblisk::bench {

/// The shape of a scene's concave bodies. The contenders differ only in it. Everything else, including the
/// settings of these shapes, is Bullet's default.
enum class ShapeKind {
  octoblisk,  ///< ClusteredOctreeShape
  bvh,        ///< btBvhTriangleMeshShape; a moving solid uses `hulls` instead
  gimpact,    ///< btGImpactMeshShape
  hulls,      ///< btCompoundShape of one btConvexHullShape for each piece
  plane,      ///< btStaticPlaneShape on top of the solid: the ideal of a flat floor
};
const char* nameOf(ShapeKind kind);

/// Shapes, with the meshes that they read.
class KeptShapes {
 public:
  template <typename Shape, typename... Arguments>
  Shape& keep(Arguments&&... arguments) {
    auto shape = std::make_unique<Shape>(std::forward<Arguments>(arguments)...);
    Shape& kept = *shape;
    shapes_.push_back(std::move(shape));
    return kept;
  }

  /// The solid's shape, of a kind.
  btCollisionShape& concave(ShapeKind kind, const Solid& solid, bool moves);

 private:
  std::vector<std::unique_ptr<gallery::BulletMesh>> meshes_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
};

}  // namespace octoblisk::bench
