// Bullet's movable concave mesh, GImpact, against itself. All margins are 0.
#include "bullet_world.h"
#include "concave_pile.h"
#include "contender.h"
#include "gimpact_shape.h"
#include "hulls_on_blisk.h"
#include "nut_on_bolt.h"
#include "primitive_on_mesh.h"

namespace octoblisk::bench {
namespace {

class GimpactShapes {
 public:
  explicit GimpactShapes(const Scene& scene) : blisk_mesh_(*scene.blisk), belt_mesh_(*scene.belt) {}

  void registerAt(btCollisionDispatcher* dispatcher) { algorithm_.registerAt(*dispatcher); }
  btCollisionShape* blisk() { return blisk_.get(); }
  btCollisionShape* belt() { return belt_.get(); }

  void refit(const BulletMesh& moved, const Aabb&) {
    blisk_mesh_.readVerticesOf(moved);
    blisk_->postUpdate();
    blisk_->updateBound();
  }

 private:
  BulletMesh blisk_mesh_, belt_mesh_;
  std::unique_ptr<btGImpactMeshShape> blisk_ = gimpactShape(blisk_mesh_), belt_ = gimpactShape(belt_mesh_);
  GimpactAlgorithm algorithm_;
};

class GimpactBuild final : public BuildQuery {
 public:
  explicit GimpactBuild(const Scene& scene) : mesh_(*scene.blisk) {}
  void build() override {
    clear();
    shape_ = gimpactShape(mesh_);
  }
  void clear() override { shape_.reset(); }

 private:
  BulletMesh mesh_;
  std::unique_ptr<btGImpactMeshShape> shape_;
};

class GimpactOnFloor {
 public:
  explicit GimpactOnFloor(const Scene& scene) : mesh_(*scene.blisk) {}
  void registerAt(btCollisionDispatcher* dispatcher) { algorithm_.registerAt(*dispatcher); }
  btCollisionShape* blisk() { return blisk_.get(); }

 private:
  BulletMesh mesh_;
  std::unique_ptr<btGImpactMeshShape> blisk_ = gimpactShape(mesh_);
  GimpactAlgorithm algorithm_;
};

class GimpactPile final : public ConcavePileQuery {
 public:
  explicit GimpactPile(const Scene&) {
    start([this](const gallery::SharedMesh& mesh) {
      meshes_.push_back(std::make_unique<BulletMesh>(*mesh));
      return gimpactShape(*meshes_.back(), gallery::ConcavePile::kMargin);
    });
    btGImpactCollisionAlgorithm::registerAlgorithm(dispatcher());
  }
  ~GimpactPile() override { stop(); }
  GimpactPile(const GimpactPile&) = delete;
  GimpactPile& operator=(const GimpactPile&) = delete;

 private:
  std::vector<std::unique_ptr<BulletMesh>> meshes_;
};

class GimpactNut final : public NutOnBoltQuery {
 public:
  explicit GimpactNut(const Scene&) {
    start([this](const gallery::SharedMesh& mesh) {
      meshes_.push_back(std::make_unique<BulletMesh>(*mesh));
      return gimpactShape(*meshes_.back());
    });
    btGImpactCollisionAlgorithm::registerAlgorithm(dispatcher());
  }
  ~GimpactNut() override { stop(); }
  GimpactNut(const GimpactNut&) = delete;
  GimpactNut& operator=(const GimpactNut&) = delete;

 private:
  std::vector<std::unique_ptr<BulletMesh>> meshes_;
};

const bool kRegistered =
    registerContender<InBulletWorld<GimpactShapes>, BulletContacts<GimpactShapes>, BulletRefit<GimpactShapes>,
                      GimpactBuild, HullsOnBlisk<GimpactOnFloor>, GimpactPile, GimpactNut,
                      PrimitiveOnMesh<GimpactOnFloor>>("gimpact") &&
    describe("gimpact", bulletVersion());

}  // namespace
}  // namespace octoblisk::bench
