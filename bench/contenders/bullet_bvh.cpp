// Bullet's static mesh, btBvhTriangleMeshShape, with the belt as a compound of convex hulls.
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "belt_of_hulls.h"
#include "bullet_world.h"
#include "contender.h"
#include "hulls_on_blisk.h"
#include "primitive_on_mesh.h"

namespace octoblisk::bench {
namespace {

class BvhShapes {
 public:
  explicit BvhShapes(const Scene& scene) : mesh_(*scene.blisk), belt_(scene) { blisk_.setMargin(0); }

  void registerAt(btCollisionDispatcher*) {}
  btCollisionShape* blisk() { return &blisk_; }
  btCollisionShape* belt() { return belt_.shape(); }

  void refit(const BulletMesh& moved, const Aabb& bounds) {
    mesh_.readVerticesOf(moved);
    blisk_.refitTree(toBullet(bounds.min), toBullet(bounds.max));
  }

 private:
  BulletMesh mesh_;
  btBvhTriangleMeshShape blisk_{mesh_.view(), true};
  BeltOfHulls belt_;
};

/// Rays without a world, by performRaycast.
class BulletBvhRays final : public RayQuery {
 public:
  explicit BulletBvhRays(const Scene& scene) : mesh_(*scene.blisk) {}

  double firstHit(const Segment& segment) override {
    Nearest nearest(toBullet(segment.from), toBullet(segment.to));
    blisk_.performRaycast(&nearest, nearest.m_from, nearest.m_to);
    return static_cast<double>(nearest.m_hitFraction);
  }

 private:
  struct Nearest : btTriangleRaycastCallback {
    using btTriangleRaycastCallback::btTriangleRaycastCallback;
    btScalar reportHit(const btVector3&, btScalar fraction, int, int) override { return fraction; }
  };

  BulletMesh mesh_;
  btBvhTriangleMeshShape blisk_{mesh_.view(), true};
};

class BulletBvhBuild final : public BuildQuery {
 public:
  explicit BulletBvhBuild(const Scene& scene) : mesh_(*scene.blisk) {}

  void build() override {
    clear();
    shape_ = std::make_unique<btBvhTriangleMeshShape>(mesh_.view(), true);
  }
  void clear() override { shape_.reset(); }

 private:
  BulletMesh mesh_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

class BvhOnFloor {
 public:
  explicit BvhOnFloor(const Scene& scene) : mesh_(*scene.blisk) {}
  void registerAt(btCollisionDispatcher*) {}
  btCollisionShape* blisk() { return &blisk_; }

 private:
  BulletMesh mesh_;
  btBvhTriangleMeshShape blisk_{mesh_.view(), true};
};

const bool kRegistered =
    registerContender<InBulletWorld<BvhShapes>, BulletContacts<BvhShapes>, BulletRefit<BvhShapes>,
                      BulletBvhRays, BulletBvhBuild, HullsOnBlisk<BvhOnFloor>, PrimitiveOnMesh<BvhOnFloor>>(
        "bullet-bvh") &&
    describe("bullet-bvh", bulletVersion());

}  // namespace
}  // namespace octoblisk::bench
