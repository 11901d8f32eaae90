// Bullet's btScaledBvhTriangleMeshShape: the blisk at half its size, scaled by two. The belt is a compound of
// convex hulls.
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>

#include "belt_of_hulls.h"
#include "bullet_world.h"
#include "contender.h"
#include "hulls_on_blisk.h"

namespace octoblisk::bench {
namespace {

class ScaledBlisk {
 public:
  explicit ScaledBlisk(const Scene& scene) : mesh_(*scene.blisk, 0.5) {}
  btCollisionShape* shape() { return &scaled_; }

 private:
  BulletMesh mesh_;
  btBvhTriangleMeshShape half_{mesh_.view(), true};
  btScaledBvhTriangleMeshShape scaled_{&half_, btVector3(2, 2, 2)};
};

class ScaledShapes {
 public:
  explicit ScaledShapes(const Scene& scene) : blisk_(scene), belt_(scene) { blisk()->setMargin(0); }
  void registerAt(btCollisionDispatcher*) {}
  btCollisionShape* blisk() { return blisk_.shape(); }
  btCollisionShape* belt() { return belt_.shape(); }

 private:
  ScaledBlisk blisk_;
  BeltOfHulls belt_;
};

class ScaledOnFloor {
 public:
  explicit ScaledOnFloor(const Scene& scene) : blisk_(scene) {}
  void registerAt(btCollisionDispatcher*) {}
  btCollisionShape* blisk() { return blisk_.shape(); }

 private:
  ScaledBlisk blisk_;
};

const bool kRegistered =
    registerContender<InBulletWorld<ScaledShapes>, HullsOnBlisk<ScaledOnFloor>>("scaled-bvh") &&
    describe("scaled-bvh", bulletVersion());

}  // namespace
}  // namespace octoblisk::bench
