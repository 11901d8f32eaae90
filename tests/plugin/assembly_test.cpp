// A nut on a bolt: the helix, the closed form of its acceleration, and friction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gallery/nut_on_bolt.h"

namespace octoblisk {
namespace {

class RunDown {
 public:
  RunDown(const shapes::Thread& thread, double friction)
      : scene_(world_, thread, 4, gallery::NutOnBolt::ourShapes()) {
    scene_.bolt().setFriction(btScalar(friction));  // Bullet multiplies those of both bodies
    scene_.nut().setFriction(1);
  }
  ~RunDown() { world_.clear(); }

  void step() {
    world_.step(1, gallery::NutOnBolt::kTimeStep);
    scene_.notice();
    off_helix_ = std::max(off_helix_, scene_.offHelix());
    tilt_ = std::max(tilt_, scene_.tilt());
  }
  const gallery::NutOnBolt& scene() const { return scene_; }
  double greatestOffHelix() const { return off_helix_; }
  double greatestTilt() const { return tilt_; }

 private:
  gallery::BulletWorld world_;
  gallery::NutOnBolt scene_;
  double off_helix_ = 0.0, tilt_ = 0.0;
};

/// With fewer facets, the nut bumps over those of the bolt, and loses energy.
TEST(NutOnBolt, runsDownTheHelixAsFastAsTheClosedFormSays) {
  struct Case {
    int size, segments;
    double slower;
  };
  for (const auto& [size, segments, slower] : {Case{4, 192, 0.05}, Case{8, 96, 0.12}, Case{20, 192, 0.05}}) {
    const shapes::Thread thread = shapes::coarseThread(size, segments);
    RunDown run(thread, 0.0);
    const double way = 0.8 * thread.pitch;
    double time = 0.0;
    for (; run.scene().sunk() < way && time < 1.0; time += gallery::NutOnBolt::kTimeStep) run.step();
    const double expected = std::sqrt(2.0 * way / run.scene().acceleration());
    EXPECT_GT(time / expected, 0.97) << 'M' << size;
    EXPECT_LT(time / expected, 1.0 + slower) << 'M' << size;
    EXPECT_LT(run.greatestOffHelix(), 0.5 * thread.play) << 'M' << size;
    EXPECT_LT(run.greatestTilt(), 0.2 * std::numbers::pi / 180.0) << 'M' << size;
  }
}

TEST(NutOnBolt, frictionSlowsItToACreep) {
  const shapes::Thread thread = shapes::coarseThread(12);
  const double lead = thread.pitch / (std::numbers::pi * thread.diameter);  // tan of the lead angle
  const auto turned = [&](double friction) {
    RunDown run(thread, friction);
    for (int step = 0; step < 120; ++step) run.step();
    return -run.scene().turned();
  };
  EXPECT_LT(turned(3.0 * lead), 0.1 * turned(0.0));
}

}  // namespace
}  // namespace octoblisk
