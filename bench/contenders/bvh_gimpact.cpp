// Bullet's solution for a moving and a static concave mesh: btBvhTriangleMeshShape for the blisk, a
// GImpact mesh for the belt. All margins are 0.
#include "bullet_world.h"
#include "contender.h"
#include "gimpact_shape.h"

namespace octoblisk::bench {
namespace {

class BvhAndGimpact {
 public:
  explicit BvhAndGimpact(const Scene& scene) : blisk_mesh_(*scene.blisk), belt_mesh_(*scene.belt) {
    blisk_.setMargin(0);
  }
  void registerAt(btCollisionDispatcher* dispatcher) { algorithm_.registerAt(*dispatcher); }
  btCollisionShape* blisk() { return &blisk_; }
  btCollisionShape* belt() { return belt_.get(); }

 private:
  BulletMesh blisk_mesh_, belt_mesh_;
  btBvhTriangleMeshShape blisk_{blisk_mesh_.view(), true};
  std::unique_ptr<btGImpactMeshShape> belt_ = gimpactShape(belt_mesh_);
  GimpactAlgorithm algorithm_;
};

/// Only contacts: closest points, rays and sweeps are the same as for bullet-bvh.
class Contacts final : public WorldContactsQuery {
 public:
  explicit Contacts(const Scene& scene) : world_(scene) {}
  std::size_t points(const Pose& belt_in_blisk) override { return world_.points(belt_in_blisk); }

 private:
  InBulletWorld<BvhAndGimpact> world_;
};

const bool kRegistered =
    registerContender<Contacts>("bvh-gimpact") && describe("bvh-gimpact", bulletVersion());

}  // namespace
}  // namespace octoblisk::bench
