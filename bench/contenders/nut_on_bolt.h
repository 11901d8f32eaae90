// The gallery's nut on its bolt, for the contenders whose concave bodies can move.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "contender.h"
#include "gallery/nut_on_bolt.h"

namespace octoblisk::bench {

class NutOnBoltQuery : public AssemblyQuery {
 public:
  ~NutOnBoltQuery() override { stop(); }

  void restart() override {
    nut_on_bolt_->restart();
    world_->getConstraintSolver()->reset();
    steps_ = 0;
    off_helix_ = 0.0;
  }
  void step() override {
    world_.step(1, gallery::NutOnBolt::kTimeStep);
    nut_on_bolt_->notice();
    ++steps_;
    off_helix_ = std::max(off_helix_, 1e3 * nut_on_bolt_->offHelix());
  }
  double sunk() const override { return 1e3 * nut_on_bolt_->sunk(); }
  double expectedSunk() const override {
    const double time = steps_ * gallery::NutOnBolt::kTimeStep;
    return 1e3 * 0.5 * nut_on_bolt_->acceleration() * time * time;
  }
  double offHelix() const override { return off_helix_; }
  double play() const override { return 1e3 * 2.0 * thread_.play * std::tan(std::numbers::pi / 6.0); }

 protected:
  void start(const gallery::MakeShape& make_shape) { nut_on_bolt_.emplace(world_, thread_, 4, make_shape); }
  /// Must be called before the shapes' meshes are destroyed.
  void stop() {
    world_.clear();
    nut_on_bolt_.reset();
  }
  btCollisionDispatcher* dispatcher() { return &world_.dispatcher(); }

 private:
  const shapes::Thread thread_ = shapes::coarseThread(16, 192);
  gallery::BulletWorld world_;
  std::optional<gallery::NutOnBolt> nut_on_bolt_;
  int steps_ = 0;
  double off_helix_ = 0.0;
};

}  // namespace octoblisk::bench
