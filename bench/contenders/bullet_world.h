// The Bullet world and its queries, shared by the contenders that use Bullet.
#pragma once

#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <limits>
#include <string>

#include "contender.h"
#include "gallery/bullet_mesh.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk::bench {

/// Bullet's version in its own notation: "Bullet 3.24, single precision".
inline std::string bulletVersion() {
  const int version = btGetVersion();
  return "Bullet " + std::to_string(version / 100) + '.' + std::to_string(version % 100) + ", " +
         (sizeof(btScalar) == sizeof(float) ? "single" : "double") + " precision";
}

using gallery::BulletMesh;

/// A world with the shapes of blisk and belt. Only the belt moves. `Shapes` is constructed from a scene. It
/// has both shapes as blisk() and belt(), and registerAt(dispatcher) for its own algorithms.
template <typename Shapes>
class InBulletWorld final : public WorldContactsQuery,
                            public WorldClosestQuery,
                            public WorldRayQuery,
                            public WorldSweepQuery {
 public:
  explicit InBulletWorld(const Scene& scene) : shapes_(scene) {
    shapes_.registerAt(&dispatcher_);
    blisk_.setCollisionShape(shapes_.blisk());
    belt_.setCollisionShape(shapes_.belt());
    world_.addCollisionObject(&blisk_);  // the belt is passed to each query and needs no place in the world
  }
  ~InBulletWorld() override { world_.removeCollisionObject(&blisk_); }
  InBulletWorld(const InBulletWorld&) = delete;
  InBulletWorld& operator=(const InBulletWorld&) = delete;

  Shapes& shapes() { return shapes_; }

  std::size_t points(const Pose& belt_in_blisk) override { return ask(belt_in_blisk, 0).touching; }

  double nearest(const Pose& belt_in_blisk, double threshold) override {
    return ask(belt_in_blisk, threshold).least;
  }

  double firstHit(const Segment& segment) override {
    const btVector3 from = toBullet(segment.from), to = toBullet(segment.to);
    btCollisionWorld::ClosestRayResultCallback nearest(from, to);
    world_.rayTest(from, to, nearest);
    return static_cast<double>(nearest.m_closestHitFraction);
  }

  double firstTouch(const Segment& segment, double radius) override {
    const btSphereShape ball(static_cast<btScalar>(radius));
    const btVector3 from = toBullet(segment.from), to = toBullet(segment.to);
    btCollisionWorld::ClosestConvexResultCallback nearest(from, to);
    const btMatrix3x3 unturned = btMatrix3x3::getIdentity();
    world_.convexSweepTest(&ball, btTransform(unturned, from), btTransform(unturned, to), nearest);
    return static_cast<double>(nearest.m_closestHitFraction);
  }

 private:
  struct Points : btCollisionWorld::ContactResultCallback {
    std::size_t touching = 0;  // of depth 0 or more
    double least = std::numeric_limits<double>::infinity();
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
      touching += point.getDistance() <= 0;
      least = std::min(least, static_cast<double>(point.getDistance()));
      return 0;
    }
  };

  Points ask(const Pose& belt_in_blisk, double threshold) {
    belt_.setWorldTransform(toBullet(belt_in_blisk));
    Points points;
    points.m_closestDistanceThreshold = static_cast<btScalar>(threshold);
    world_.contactPairTest(&blisk_, &belt_, points);
    return points;
  }

  Shapes shapes_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  btCollisionObject blisk_, belt_;
};

/// Fits the blisk's shape to vertices that have already moved, by refit(mesh, bounds) of the shapes.
/// contactPairTest then gives the answers.
template <typename Shapes>
class BulletRefit final : public RefitQuery {
 public:
  explicit BulletRefit(const Scene& scene) : BulletRefit(scene, *bench::bent(*scene.blisk)) {}
  void refit(bool bent) override {
    world_.shapes().refit(bent ? bent_ : unbent_, bent ? bounds_of_bent_ : bounds_of_unbent_);
  }
  bool touches(const Pose& belt_in_blisk) override { return world_.points(belt_in_blisk) > 0; }

 private:
  BulletRefit(const Scene& scene, const TriangleMesh& bent)
      : unbent_(*scene.blisk),
        bent_(bent),
        bounds_of_unbent_(scene.blisk->bounds()),
        bounds_of_bent_(bent.bounds()),
        world_(scene) {}

  BulletMesh unbent_, bent_;
  Aabb bounds_of_unbent_, bounds_of_bent_;
  InBulletWorld<Shapes> world_;
};

/// Only the contact points of a world, by pairs of a triangle and a hull, or of two triangles.
template <typename Shapes>
class BulletContacts final : public ContactsQuery {
 public:
  explicit BulletContacts(const Scene& scene) : world_(scene) {}
  std::size_t contacts(const Pose& belt_in_blisk) override { return world_.points(belt_in_blisk); }
  bool countsPairs() const override { return false; }

 private:
  InBulletWorld<Shapes> world_;
};

}  // namespace octoblisk::bench
