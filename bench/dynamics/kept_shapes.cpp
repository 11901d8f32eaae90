#include "dynamics/kept_shapes.h"

#include <btBulletCollisionCommon.h>

#include <stdexcept>

#include "contenders/gimpact_shape.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk::bench {

const char* nameOf(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::octoblisk:
      return "octoblisk";
    case ShapeKind::bvh:
      return "bullet-bvh";
    case ShapeKind::gimpact:
      return "gimpact";
    case ShapeKind::hulls:
      return "hulls";
    case ShapeKind::plane:
      return "plane";
  }
  return "";
}

btCollisionShape& KeptShapes::concave(ShapeKind kind, const Solid& solid, bool moves) {
  const auto mesh = [&] {
    meshes_.push_back(std::make_unique<gallery::BulletMesh>(*solid.mesh));
    return meshes_.back()->view();
  };
  switch (kind) {
    case ShapeKind::octoblisk:
      return keep<ClusteredOctreeShape>(mesh());
    case ShapeKind::gimpact: {
      auto& shape = keep<btGImpactMeshShape>(mesh());
      shape.updateBound();
      return shape;
    }
    case ShapeKind::bvh:
      if (!moves) return keep<btBvhTriangleMeshShape>(mesh(), true);
      [[fallthrough]];
    case ShapeKind::hulls: {
      if (solid.pieces.empty()) throw std::logic_error("a solid without pieces cannot use hulls");
      auto& compound = keep<btCompoundShape>();
      for (const auto& piece : solid.pieces) {
        auto& hull = keep<btConvexHullShape>();
        for (const std::uint32_t vertex : piece)
          hull.addPoint(toBullet(solid.mesh->vertices()[vertex]), false);
        hull.recalcLocalAabb();
        compound.addChildShape(btTransform::getIdentity(), &hull);
      }
      return compound;
    }
    case ShapeKind::plane:
      break;
  }
  if (moves) throw std::logic_error("a plane cannot move");
  return keep<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(solid.mesh->bounds().max.z()));
}

}  // namespace octoblisk::bench
