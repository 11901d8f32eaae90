// Bullet's movable concave mesh, and its algorithm for worlds and for contactPairTest.
#pragma once

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <memory>

#include "gallery/bullet_mesh.h"

namespace octoblisk::bench {

inline std::unique_ptr<btGImpactMeshShape> gimpactShape(const gallery::BulletMesh& mesh,
                                                        btScalar margin = 0) {
  auto shape = std::make_unique<btGImpactMeshShape>(mesh.view());
  shape->setMargin(margin);
  shape->updateBound();
  return shape;
}

/// Must outlive the dispatchers it is registered with.
class GimpactAlgorithm {
 public:
  void registerAt(btCollisionDispatcher& dispatcher) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
    // GImpact registers itself only for stepping. contactPairTest uses another table.
    for (int other = 0; other < MAX_BROADPHASE_COLLISION_TYPES; ++other) {
      dispatcher.registerClosestPointsCreateFunc(GIMPACT_SHAPE_PROXYTYPE, other, &create_);
      dispatcher.registerClosestPointsCreateFunc(other, GIMPACT_SHAPE_PROXYTYPE, &create_);
    }
  }

 private:
  btGImpactCollisionAlgorithm::CreateFunc create_;
};

}  // namespace octoblisk::bench
