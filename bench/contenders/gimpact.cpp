// Bullet's movable concave mesh, GImpact, against itself. All margins are 0.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include "bullet_world.h"
#include "concave_pile.h"
#include "contender.h"
#include "hulls_on_blisk.h"

namespace octoblisk::bench {
namespace {

std::unique_ptr<btGImpactMeshShape> shapeOf(const BulletMesh& mesh, btScalar margin = 0) {
  auto shape = std::make_unique<btGImpactMeshShape>(mesh.view());
  shape->setMargin(margin);
  shape->updateBound();
  return shape;
}

class GimpactShapes {
 public:
  explicit GimpactShapes(const Scene& scene) : blisk_mesh_(*scene.blisk), belt_mesh_(*scene.belt) {}

  void registerAt(btCollisionDispatcher* dispatcher) {
    btGImpactCollisionAlgorithm::registerAlgorithm(dispatcher);
    // It registers itself for stepping alone; contactPairTest looks into another table.
    for (int other = 0; other < MAX_BROADPHASE_COLLISION_TYPES; ++other) {
      dispatcher->registerClosestPointsCreateFunc(GIMPACT_SHAPE_PROXYTYPE, other, &create_);
      dispatcher->registerClosestPointsCreateFunc(other, GIMPACT_SHAPE_PROXYTYPE, &create_);
    }
  }
  btCollisionShape* blisk() { return blisk_.get(); }
  btCollisionShape* belt() { return belt_.get(); }

  void refit(const TriangleMesh& deformed) {
    blisk_mesh_.move(deformed);
    blisk_->postUpdate();
    blisk_->updateBound();
  }

 private:
  BulletMesh blisk_mesh_, belt_mesh_;
  std::unique_ptr<btGImpactMeshShape> blisk_ = shapeOf(blisk_mesh_), belt_ = shapeOf(belt_mesh_);
  btGImpactCollisionAlgorithm::CreateFunc create_;
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

class GimpactOnFloor {
 public:
  explicit GimpactOnFloor(const Scene& scene) : mesh_(*scene.blisk) {}
  void registerAt(btCollisionDispatcher* dispatcher) {
    btGImpactCollisionAlgorithm::registerAlgorithm(dispatcher);
  }
  btCollisionShape* blisk() {
    blisk_->updateBound();
    return blisk_.get();
  }

 private:
  BulletMesh mesh_;
  std::unique_ptr<btGImpactMeshShape> blisk_ = shapeOf(mesh_);
};

class GimpactPile final : public ConcavePileQuery {
 public:
  explicit GimpactPile(const Scene&) {
    start([this](const gallery::SharedMesh& mesh) {
      meshes_.push_back(std::make_unique<BulletMesh>(*mesh));
      return shapeOf(*meshes_.back(), gallery::ConcavePile::kMargin);
    });
    btGImpactCollisionAlgorithm::registerAlgorithm(dispatcher());
  }
  ~GimpactPile() override { stop(); }
  GimpactPile(const GimpactPile&) = delete;
  GimpactPile& operator=(const GimpactPile&) = delete;

 private:
  std::vector<std::unique_ptr<BulletMesh>> meshes_;
};

const bool kRegistered =
    registerContender<InBulletWorld<GimpactShapes>, BulletContacts<GimpactShapes>, BulletRefit<GimpactShapes>,
                      GimpactBuild, HullsOnBlisk<GimpactOnFloor>, GimpactPile>("gimpact") &&
    describe("gimpact", bulletVersion());

}  // namespace
}  // namespace octoblisk::bench
