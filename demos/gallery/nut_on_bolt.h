// A nut that runs down a bolt in a Bullet world.
#pragma once

#include <memory>

#include "gallery/concave_pile.h"
#include "gallery/nut_run.h"

namespace octoblisk::gallery {

class NutOnBolt : public NutRun {
 public:
  /// Makes our shape with its default margin.
  static MakeShape ourShapes(const BuildOptions& tree = {}) {
    return [tree](const SharedMesh& mesh) {
      return std::make_unique<ClusteredOctreeShape>(
          std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh, tree)));
    };
  }

  NutOnBolt(BulletWorld& world, const shapes::Thread& thread, int pitches, const MakeShape& make_shape)
      : NutRun(thread, pitches),
        world_(world),
        bolt_shape_(make_shape(boltMesh())),
        nut_shape_(make_shape(nutMesh())),
        bolt_(world.add(*bolt_shape_, 0, at(0, 0, 0))),
        nut_(world.add(*nut_shape_, btScalar(kMass), toBullet(poseAt(0)))) {
    nut_.setMassProps(btScalar(kMass), toBullet(moments()));
    nut_.updateInertiaTensor();
    nut_.setFriction(0);
    nut_.setActivationState(DISABLE_DEACTIVATION);
  }

  btRigidBody& bolt() { return bolt_; }
  btRigidBody& nut() { return nut_; }

  /// Puts the nut at its start, at rest.
  void restart() {
    world_->removeRigidBody(&nut_);  // also removes its pairs
    const btTransform start = toBullet(poseAt(0));
    nut_.setWorldTransform(start);
    nut_.setInterpolationWorldTransform(start);
    nut_.setLinearVelocity(btVector3(0, 0, 0));
    nut_.setAngularVelocity(btVector3(0, 0, 0));
    nut_.clearForces();
    world_->addRigidBody(&nut_);
    noticeRestart();
  }

  /// Call this after each step.
  void notice() { NutRun::notice(fromBullet(nut_.getWorldTransform())); }

 private:
  BulletWorld& world_;
  std::unique_ptr<btCollisionShape> bolt_shape_, nut_shape_;
  btRigidBody& bolt_;
  btRigidBody& nut_;
};

}  // namespace octoblisk::gallery
