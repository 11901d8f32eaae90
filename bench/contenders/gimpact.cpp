// Bullet's movable concave mesh, GImpact, against itself. All margins are 0.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include "bullet_world.h"
#include "contender.h"
#include "hulls_on_blisk.h"

namespace octoblisk::bench {
namespace {

std::unique_ptr<btGImpactMeshShape> shapeOf(const BulletMesh& mesh) {
  auto shape = std::make_unique<btGImpactMeshShape>(mesh.view());
  shape->setMargin(0);
  shape->updateBound();
  return shape;
}

/// Counts contact points, each with its depth.
class Gimpact final : public ContactsQuery, public WorldContactsQuery {
 public:
  explicit Gimpact(const Scene& scene) : blisk_mesh_(*scene.blisk), belt_mesh_(*scene.belt) {
    btCollisionDispatcher& dispatcher = world_.dispatcher();
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
    // It registers itself for stepping alone; contactPairTest looks into another table.
    for (int other = 0; other < MAX_BROADPHASE_COLLISION_TYPES; ++other) {
      dispatcher.registerClosestPointsCreateFunc(GIMPACT_SHAPE_PROXYTYPE, other, &create_);
      dispatcher.registerClosestPointsCreateFunc(other, GIMPACT_SHAPE_PROXYTYPE, &create_);
    }
  }

  std::size_t points(const Pose& belt_in_blisk) override { return world_.contacts(belt_in_blisk); }
  std::size_t contacts(const Pose& belt_in_blisk) override { return points(belt_in_blisk); }
  bool countsPairs() const override { return false; }

 private:
  BulletMesh blisk_mesh_, belt_mesh_;
  std::unique_ptr<btGImpactMeshShape> blisk_ = shapeOf(blisk_mesh_), belt_ = shapeOf(belt_mesh_);
  btGImpactCollisionAlgorithm::CreateFunc create_;
  BulletWorld world_{blisk_.get(), belt_.get()};
};

class GimpactBuild final : public BuildQuery {
 public:
  explicit GimpactBuild(const Scene& scene) : mesh_(*scene.blisk) {}
  void build() override {
    clear();
    shape_ = shapeOf(mesh_);
  }
  void clear() override { shape_.reset(); }

 private:
  BulletMesh mesh_;
  std::unique_ptr<btGImpactMeshShape> shape_;
};

class GimpactSteps final : public HullsOnBlisk {
 public:
  explicit GimpactSteps(const Scene& scene) : mesh_(*scene.blisk) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher());
    blisk_->setMargin(kMargin);
    blisk_->updateBound();
    start(blisk_.get());
  }
  ~GimpactSteps() override { stop(); }

 private:
  BulletMesh mesh_;
  std::unique_ptr<btGImpactMeshShape> blisk_ = shapeOf(mesh_);
};

const bool kRegistered = registerContender<Gimpact, GimpactBuild, GimpactSteps>("gimpact");

}  // namespace
}  // namespace octoblisk::bench
