// A headless Bullet world with our algorithms registered.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::gallery {

class BulletWorld {
 public:
  BulletWorld() : world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    registerAlgorithm(&dispatcher_);
    world_.setGravity(btVector3(0, 0, btScalar(-9.81)));
  }
  ~BulletWorld() { clear(); }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  /// Removes all bodies. Shapes that do not outlive the world must outlive their bodies.
  void clear() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    bodies_.clear();
  }

  /// Mass 0: static. The shape must outlive the body.
  btRigidBody& add(btCollisionShape& shape, btScalar mass, const btTransform& pose) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    bodies_.push_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    bodies_.back()->setWorldTransform(pose);
    bodies_.back()->setInterpolationWorldTransform(pose);
    world_.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }

  /// `time_step`: s.
  void step(int steps, double time_step = 1.0 / 240.0) {
    for (int i = 0; i < steps; ++i) world_.stepSimulation(btScalar(time_step), 0);
  }

  /// J, of all moving bodies.
  double kineticEnergy() const {
    double energy = 0.0;
    for (const auto& body : bodies_) {
      if (body->isStaticOrKinematicObject()) continue;
      const Vec3 spin =
          fromBullet(body->getWorldTransform().getBasis().transpose() * body->getAngularVelocity());
      energy += 0.5 / double(body->getInvMass()) * double(body->getLinearVelocity().length2()) +
                0.5 * spin.cwiseAbs2().dot(fromBullet(body->getLocalInertia()));
    }
    return energy;
  }

  /// Over all pairs.
  int contactPoints() const {
    int points = 0;
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m)
      points += dispatcher_.getManifoldByIndexInternal(m)->getNumContacts();
    return points;
  }

  btDiscreteDynamicsWorld& operator*() { return world_; }
  btDiscreteDynamicsWorld* operator->() { return &world_; }
  btCollisionDispatcher& dispatcher() { return dispatcher_; }
  const btCollisionDispatcher& dispatcher() const { return dispatcher_; }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

inline btTransform at(double x, double y, double z) {
  return btTransform(btQuaternion::getIdentity(), toBullet(Vec3(x, y, z)));
}

}  // namespace octoblisk::gallery
