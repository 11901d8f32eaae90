// A Bullet world in which convex hulls fall onto the blisk, for contenders that differ only in the blisk's
// shape.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "bullet_world.h"
#include "contender.h"

namespace octoblisk::bench {

/// Hulls of 20 corners on a sphere of 6 mm, in opposite pairs, start above the blades. The blisk lies on a
/// floor within a ring of walls. Units: millimetres and seconds. A step is 1/240 s. The bodies never sleep.
/// `Blisk` is constructed from a scene. It has blisk(), and registerAt(dispatcher) for its own algorithms.
template <typename Blisk>
class HullsOnBlisk final : public WorldStepQuery {
 public:
  explicit HullsOnBlisk(const Scene& scene) : shape_(scene) {
    shape_.registerAt(&dispatcher_);
    shape_.blisk()->setMargin(kMargin);
    world_.setGravity(btVector3(0, 0, -9810));
    blisk_ = addStatic(shape_.blisk(), btTransform::getIdentity());
    addStatic(&floor_, btTransform::getIdentity());
    for (int k = 0; k < kWalls; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kWalls;
      addStatic(&wall_, at(btQuaternion(btVector3(0, 0, 1), btScalar(angle)),
                           {247.0 * std::cos(angle), 247.0 * std::sin(angle), 100.0}));
    }
  }
  ~HullsOnBlisk() override {
    for (const Hull& hull : hulls_) world_.removeRigidBody(hull.body.get());
    for (const auto& body : statics_) world_.removeRigidBody(body.get());
  }
  HullsOnBlisk(const HullsOnBlisk&) = delete;
  HullsOnBlisk& operator=(const HullsOnBlisk&) = delete;

  void restart(std::size_t bodies) override {
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m)
      dispatcher_.clearManifold(dispatcher_.getManifoldByIndexInternal(m));
    while (hulls_.size() < bodies) addHull();
    for (std::size_t k = 0; k < hulls_.size(); ++k) {
      btRigidBody& body = *hulls_[k].body;
      body.setWorldTransform(startOf(k));
      body.setInterpolationWorldTransform(startOf(k));
      body.setLinearVelocity(btVector3(0, 0, 0));
      body.setAngularVelocity(btVector3(0, 0, 0));
      body.clearForces();
      if (!body.isInWorld()) world_.addRigidBody(&body);
    }
    solver_.reset();
  }

  void step() override { world_.stepSimulation(btScalar(1.0 / 240.0), 0); }

  std::vector<Vec3> positions() const override {
    std::vector<Vec3> all;
    for (const Hull& hull : hulls_) {
      const btVector3& at = hull.body->getWorldTransform().getOrigin();
      all.emplace_back(at.x(), at.y(), at.z());
    }
    return all;
  }

  std::size_t contactsOnBlisk() const override {
    std::size_t count = 0;
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      const btPersistentManifold* manifold = dispatcher_.getManifoldByIndexInternal(m);
      if (manifold->getBody0() != blisk_ && manifold->getBody1() != blisk_) continue;
      count += static_cast<std::size_t>(manifold->getNumContacts());
    }
    return count;
  }

 private:
  struct Hull {
    std::unique_ptr<btConvexHullShape> shape;
    std::unique_ptr<btRigidBody> body;
  };
  static constexpr btScalar kMargin = btScalar(0.04);  // Bullet's default
  static constexpr int kWalls = 24;

  static btTransform at(const btQuaternion& rotation, const Vec3& place) {
    return btTransform(rotation, toBullet(place));
  }
  /// Stacks layers above the blades. Up to 1,000 hulls: 40 to a layer, on ten rings. More hulls: 400 to a
  /// layer, spread evenly over the same ring (H. Vogel, A better way to construct the sunflower head, 1979).
  /// With 40 to a layer they would start metres up.
  btTransform startOf(std::size_t k) const {
    constexpr double kInner = 140.0, kOuter = 216.5;
    const bool is_dense = hulls_.size() > 1000;
    const std::size_t in_layer = is_dense ? 400 : 40;
    const double part = (static_cast<double>(k % in_layer) + 0.5) / static_cast<double>(in_layer);
    const double radius = is_dense ? std::sqrt(std::lerp(kInner * kInner, kOuter * kOuter, part))
                                   : kInner + 8.5 * static_cast<double>(k % 10);
    const double angle = 2.0 * std::numbers::pi * 0.618 * static_cast<double>(k);
    return at(btQuaternion::getIdentity(), {radius * std::cos(angle), radius * std::sin(angle),
                                            115.0 + 15.0 * static_cast<double>(k / in_layer)});
  }
  void addHull() {
    Hull hull{std::make_unique<btConvexHullShape>(), nullptr};
    for (int pair = 0; pair < 10; ++pair) {
      Vec3 direction;
      for (int k = 2; k >= 0; --k) direction[k] = normal_(random_);
      const btVector3 corner = toBullet(6.0 * direction.normalized());
      hull.shape->addPoint(corner, false);
      hull.shape->addPoint(-corner, false);
    }
    hull.shape->recalcLocalAabb();
    btVector3 inertia;
    hull.shape->calculateLocalInertia(1, inertia);
    hull.body = std::make_unique<btRigidBody>(1, nullptr, hull.shape.get(), inertia);
    hull.body->setFriction(btScalar(0.5));
    hull.body->setActivationState(DISABLE_DEACTIVATION);
    hulls_.push_back(std::move(hull));
  }
  btRigidBody* addStatic(btCollisionShape* shape, const btTransform& where) {
    statics_.push_back(std::make_unique<btRigidBody>(0, nullptr, shape));
    statics_.back()->setWorldTransform(where);
    statics_.back()->setFriction(btScalar(0.5));
    world_.addRigidBody(statics_.back().get());
    return statics_.back().get();
  }

  Blisk shape_;
  btDefaultCollisionConfiguration configuration_;
  mutable btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btStaticPlaneShape floor_{btVector3(0, 0, 1), btScalar(kFloor)};
  btBoxShape wall_{btVector3(5, 36, 150)};
  std::vector<std::unique_ptr<btRigidBody>> statics_;
  std::vector<Hull> hulls_;
  const btRigidBody* blisk_ = nullptr;
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

}  // namespace octoblisk::bench
