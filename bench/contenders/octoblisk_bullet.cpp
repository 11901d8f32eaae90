// OctoBlisk in Bullet: the plugin's shapes in a Bullet world.
#include "bullet_world.h"
#include "concave_pile.h"
#include "contender.h"
#include "hulls_on_blisk.h"
#include "nut_on_bolt.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/register.h"
#include "primitive_on_mesh.h"

namespace octoblisk::bench {
namespace {

std::shared_ptr<const ClusteredOctree> treeOf(const std::shared_ptr<const TriangleMesh>& mesh) {
  return std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh));
}

class OurShapes {
 public:
  explicit OurShapes(const Scene& scene) : blisk_(treeOf(scene.blisk)), belt_(treeOf(scene.belt)) {
    for (ClusteredOctreeShape* shape : {&blisk_, &belt_}) {
      shape->setMargin(0);
      shape->setContactBreakingThreshold(0);
    }
  }

  void registerAt(btCollisionDispatcher* dispatcher) { registerAlgorithm(dispatcher); }
  btCollisionShape* blisk() { return &blisk_; }
  btCollisionShape* belt() { return &belt_; }

 private:
  ClusteredOctreeShape blisk_, belt_;
};

class OursOnFloor {
 public:
  explicit OursOnFloor(const Scene& scene) : blisk_(treeOf(scene.blisk)) {}
  void registerAt(btCollisionDispatcher* dispatcher) { registerAlgorithm(dispatcher); }
  btCollisionShape* blisk() { return &blisk_; }

 private:
  ClusteredOctreeShape blisk_;
};

/// Reports no points for bodies that are apart.
class OurSmallMesh {
 public:
  explicit OurSmallMesh(const Scene& scene) : mesh_(treeOf(scene.blisk)) {
    mesh_.setContactBreakingThreshold(0);
  }
  void registerAt(btCollisionDispatcher* dispatcher) { registerAlgorithm(dispatcher); }
  btCollisionShape* blisk() { return &mesh_; }

 private:
  ClusteredOctreeShape mesh_;
};

class OurPile final : public ConcavePileQuery {
 public:
  explicit OurPile(const Scene&) {
    start([](const std::shared_ptr<const TriangleMesh>& mesh) { return gallery::makeOurShape(mesh); });
  }
};

class OurNut final : public NutOnBoltQuery {
 public:
  explicit OurNut(const Scene&) { start(gallery::NutOnBolt::ourShapes()); }
};

/// The shape: also copies the mesh, and computes mass properties and thickness.
class OurShapeBuild final : public BuildQuery {
 public:
  explicit OurShapeBuild(const Scene& scene) : mesh_(*scene.blisk) {}
  void build() override {
    clear();
    shape_ = std::make_unique<ClusteredOctreeShape>(mesh_.view());
  }
  void clear() override { shape_.reset(); }

 private:
  BulletMesh mesh_;
  std::unique_ptr<ClusteredOctreeShape> shape_;
};

const bool kShape = registerContender<OurShapeBuild>("octoblisk-shape");
const bool kRegistered = registerContender<InBulletWorld<OurShapes>, HullsOnBlisk<OursOnFloor>, OurPile,
                                           OurNut, PrimitiveOnMesh<OurSmallMesh>>(kOurs);

}  // namespace
}  // namespace octoblisk::bench
