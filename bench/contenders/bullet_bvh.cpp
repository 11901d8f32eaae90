// Bullet's static mesh, btBvhTriangleMeshShape, with the belt as a compound of 128 convex hulls: two concave
// meshes have no contacts in Bullet otherwise, but by GImpact.
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "bullet_world.h"
#include "contender.h"
#include "hulls_on_blisk.h"
#include "models/belt_grinder.h"

namespace octoblisk::bench {
namespace {

/// The belt in slices of a few stations each, neighbours sharing a station. All margins are 0.
class BeltOfHulls {
 public:
  explicit BeltOfHulls(const TriangleMesh& belt) {
    constexpr std::size_t kSlices = 128;
    const demos::BeltParameters parameters;
    const auto stations = static_cast<std::size_t>(parameters.stations);
    const auto points = static_cast<std::size_t>(parameters.points_per_station);
    for (std::size_t slice = 0; slice < kSlices; ++slice) {
      auto hull = std::make_unique<btConvexHullShape>();
      hull->setMargin(0);
      for (std::size_t station = slice * stations / kSlices; station <= (slice + 1) * stations / kSlices;
           ++station) {
        for (std::size_t point = 0; point < points; ++point) {
          hull->addPoint(toBullet(belt.vertices()[station % stations * points + point]), false);
        }
      }
      hull->optimizeConvexHull();
      hull->recalcLocalAabb();
      whole_.addChildShape(btTransform::getIdentity(), hull.get());
      hulls_.push_back(std::move(hull));
    }
    whole_.setMargin(0);
  }

  btCompoundShape* shape() { return &whole_; }

 private:
  std::vector<std::unique_ptr<btConvexHullShape>> hulls_;
  btCompoundShape whole_;
};

/// Counts contact points between triangles and hulls, each with its depth.
class BulletBvh final : public ContactsQuery, public WorldContactsQuery {
 public:
  explicit BulletBvh(const Scene& scene) : mesh_(*scene.blisk), belt_(*scene.belt) { blisk_.setMargin(0); }

  std::size_t points(const Pose& belt_in_blisk) override { return world_.contacts(belt_in_blisk); }
  std::size_t contacts(const Pose& belt_in_blisk) override { return points(belt_in_blisk); }
  bool countsPairs() const override { return false; }

 private:
  BulletMesh mesh_;
  btBvhTriangleMeshShape blisk_{mesh_.view(), true};
  BeltOfHulls belt_;
  BulletWorld world_{&blisk_, belt_.shape()};
};

class BulletBvhRays final : public RayQuery {
 public:
  explicit BulletBvhRays(const Scene& scene) : mesh_(*scene.blisk) {}

  double firstHit(const Segment& way) override {
    Nearest nearest(toBullet(way.from), toBullet(way.to));
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

class BulletBvhSteps final : public HullsOnBlisk {
 public:
  explicit BulletBvhSteps(const Scene& scene) : mesh_(*scene.blisk) {
    blisk_.setMargin(kMargin);
    start(&blisk_);
  }
  ~BulletBvhSteps() override { stop(); }

 private:
  BulletMesh mesh_;
  btBvhTriangleMeshShape blisk_{mesh_.view(), true};
};

const bool kRegistered =
    registerContender<BulletBvh, BulletBvhRays, BulletBvhBuild, BulletBvhSteps>("bullet-bvh");

}  // namespace
}  // namespace octoblisk::bench
