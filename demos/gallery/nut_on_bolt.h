// A nut that runs down a bolt in a Bullet world, and the closed form of its motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "gallery/concave_pile.h"
#include "octoblisk/mass_properties.h"
#include "shapes/threads.h"

namespace octoblisk::gallery {

/// Lengths in m, angles in rad. The bolt stands on its head. The nut starts in phase with it.
class NutOnBolt {
 public:
  static constexpr double kTimeStep = 1.0 / 240.0;  ///< s
  static constexpr double kMass = 0.03;             ///< kg, of the nut

  /// Makes our shape with its default margin.
  static MakeShape ourShapes(const BuildOptions& tree = {}) {
    return [tree](const SharedMesh& mesh) {
      return std::make_unique<ClusteredOctreeShape>(
          std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh, tree)));
    };
  }

  /// `pitches`: the height of the nut's lower side over the head at the start.
  NutOnBolt(BulletWorld& world, const shapes::Thread& thread, int pitches, const MakeShape& make_shape)
      : world_(world), pitch_(thread.pitch) {
    const double height = 0.8 * thread.diameter, low = pitches * pitch_;
    const shapes::SharedMesh bolt = shapes::bolt(thread, low + height + 3.0 * pitch_);
    const shapes::SharedMesh nut = centred(*shapes::nut(thread, height), 0.5 * height);
    bolt_shape_ = make_shape(bolt);
    nut_shape_ = make_shape(nut);
    bolt_ = &world.add(*bolt_shape_, 0, at(0, 0, 0));
    start_ = low + 0.5 * height;
    nut_ = &world.add(*nut_shape_, btScalar(kMass), at(0, 0, start_));
    const Vec3 moments = kMass * massProperties(*nut).inertia.diagonal();
    nut_->setMassProps(btScalar(kMass), toBullet(moments));
    nut_->updateInertiaTensor();
    nut_->setFriction(0);
    nut_->setActivationState(DISABLE_DEACTIVATION);
    const double lead = pitch_ / kTurn;
    acceleration_ = kGravity / (1.0 + moments.z() / (kMass * lead * lead));
  }

  btRigidBody& bolt() { return *bolt_; }
  btRigidBody& nut() { return *nut_; }

  /// Puts the nut at its start, at rest.
  void restart() {
    world_->removeRigidBody(nut_);  // also removes its pairs
    const btTransform start = at(0, 0, start_);
    nut_->setWorldTransform(start);
    nut_->setInterpolationWorldTransform(start);
    nut_->setLinearVelocity(btVector3(0, 0, 0));
    nut_->setAngularVelocity(btVector3(0, 0, 0));
    nut_->clearForces();
    world_->addRigidBody(nut_);
    turned_ = 0.0;
  }

  /// Call this after each step. The nut must turn by less than half a turn in a step.
  void notice() {
    const btMatrix3x3& axes = nut_->getWorldTransform().getBasis();
    turned_ += std::remainder(std::atan2(double(axes[1][0]), double(axes[0][0])) - turned_, kTurn);
  }

  double turned() const { return turned_; }  ///< less than 0 if the nut runs down
  double sunk() const { return start_ - double(nut_->getWorldTransform().getOrigin().z()); }
  /// How far the nut is above or below the helix, on which it has turned as far.
  double offHelix() const { return std::abs(sunk() + pitch_ * turned_ / kTurn); }
  double tilt() const { return std::acos(std::min(1.0, double(nut_->getWorldTransform().getBasis()[2][2]))); }

  /// m/s², along the axis, without friction or play: the weight of the nut moves and spins it.
  double acceleration() const { return acceleration_; }

 private:
  static constexpr double kTurn = 2.0 * std::numbers::pi, kGravity = 9.81;

  static shapes::SharedMesh centred(const TriangleMesh& mesh, double middle) {
    std::vector<Vec3> vertices = mesh.vertices();
    for (Vec3& vertex : vertices) vertex.z() -= middle;
    return std::make_shared<const TriangleMesh>(std::move(vertices), mesh.triangles());
  }

  BulletWorld& world_;
  double pitch_, start_ = 0.0, acceleration_ = 0.0, turned_ = 0.0;
  std::unique_ptr<btCollisionShape> bolt_shape_, nut_shape_;
  btRigidBody* bolt_;
  btRigidBody* nut_;
};

}  // namespace octoblisk::gallery
