// A nut on a bolt: the helix, the closed form of its acceleration, and friction that holds it.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shapes/threads.h"

namespace octoblisk {
namespace {

using testing::BulletWorld;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kStep = 1.0 / 240.0;

/// A bolt that stands, and a nut on it, some pitches above the head, in phase.
class NutOnBolt {
 public:
  NutOnBolt(const shapes::Thread& thread, double friction)
      : thread_(thread),
        bolt_(treeOver(shapes::bolt(thread, 2.5 * thread.diameter))),
        nut_(treeOver(shapes::nut(thread, 0.8 * thread.diameter))),
        start_(4.0 * thread.pitch) {
    world_.add(bolt_, 0, testing::at(0, 0, 0)).setFriction(btScalar(friction));
    btVector3 moments;
    nut_.calculatePrincipalAxisTransform(kMass, principal_, moments);
    inertia_ = double(moments.z());
    compound_.addChildShape(principal_.inverse(), &nut_);
    body_ =
        &world_.add(compound_, kMass,
                    btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(start_))) * principal_);
    body_->setMassProps(kMass, moments);
    body_->setFriction(btScalar(friction));
    body_->setActivationState(DISABLE_DEACTIVATION);
  }

  void step() {
    world_.step(1, kStep);
    const btTransform nut = body_->getWorldTransform() * principal_.inverse();
    const double angle = std::atan2(double(nut.getBasis()[1][0]), double(nut.getBasis()[0][0]));
    turned_ += std::remainder(angle - turned_, kTurn);
    const double height = double(nut.getOrigin().z());
    sunk_ = start_ - height;
    off_helix_ = std::max(off_helix_, std::abs(height - start_ - thread_.pitch * turned_ / kTurn));
    tilt_ = std::max(tilt_, std::acos(std::min(1.0, double(nut.getBasis()[2][2]))));
  }

  double turned() const { return turned_; }  ///< rad; down is negative
  double sunk() const { return sunk_; }
  double greatestOffHelix() const { return off_helix_; }
  double greatestTilt() const { return tilt_; }

  /// Of a nut without friction or play: its weight moves it and spins it.
  double acceleration() const {
    const double lead = thread_.pitch / kTurn;
    return kGravity / (1.0 + inertia_ / (kMass * lead * lead));
  }

 private:
  static constexpr double kGravity = 9.81;
  static constexpr btScalar kMass = btScalar(0.03);

  const shapes::Thread thread_;
  ClusteredOctreeShape bolt_, nut_;
  const double start_;
  btCompoundShape compound_;
  BulletWorld world_;
  btTransform principal_;
  btRigidBody* body_;
  double inertia_, turned_ = 0.0, sunk_ = 0.0, off_helix_ = 0.0, tilt_ = 0.0;
};

/// With fewer facets, the nut bumps over those of the bolt, and loses energy.
TEST(NutOnBolt, runsDownTheHelixAsFastAsTheClosedFormSays) {
  struct Case {
    int size, segments;
    double slower;
  };
  for (const auto& [size, segments, slower] : {Case{4, 192, 0.05}, Case{8, 96, 0.12}, Case{20, 192, 0.05}}) {
    shapes::Thread thread = shapes::coarseThread(size);
    thread.segments = segments;
    NutOnBolt scene(thread, 0.0);
    const double way = 0.8 * thread.pitch;
    double time = 0.0;
    for (; scene.sunk() < way && time < 1.0; time += kStep) scene.step();
    const double expected = std::sqrt(2.0 * way / scene.acceleration());
    EXPECT_GT(time / expected, 0.97) << 'M' << size;
    EXPECT_LT(time / expected, 1.0 + slower) << 'M' << size;
    EXPECT_LT(scene.greatestOffHelix(), 0.5 * thread.play) << 'M' << size;
    EXPECT_LT(scene.greatestTilt(), 0.2 * std::numbers::pi / 180.0) << 'M' << size;
  }
}

TEST(NutOnBolt, frictionHoldsIt) {
  const shapes::Thread thread = shapes::coarseThread(12);
  const double lead = thread.pitch / (std::numbers::pi * thread.diameter);  // tan of the lead angle
  const auto turned = [&](double friction) {
    NutOnBolt scene(thread, std::sqrt(friction));  // Bullet multiplies those of both bodies
    for (int step = 0; step < 120; ++step) scene.step();
    return -scene.turned();
  };
  EXPECT_LT(turned(3.0 * lead), 0.1 * turned(0.0));  // it creeps
}

}  // namespace
}  // namespace octoblisk
