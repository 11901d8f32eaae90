// The gallery's nut on its bolt, for the contenders in Bullet whose concave bodies can move.
#pragma once

#include <optional>

#include "gallery/nut_on_bolt.h"
#include "rated_nut.h"

namespace octoblisk::bench {

class NutOnBoltQuery : public RatedNut {
 public:
  ~NutOnBoltQuery() override { stop(); }

 protected:
  void start(const gallery::MakeShape& make_shape) {
    nut_on_bolt_.emplace(world_, kNutThread, kNutPitches, make_shape);
  }
  /// Must be called before the shapes' meshes are destroyed.
  void stop() {
    world_.clear();
    nut_on_bolt_.reset();
  }
  btCollisionDispatcher* dispatcher() { return &world_.dispatcher(); }

 private:
  void putBack() override {
    nut_on_bolt_->restart();
    world_->getConstraintSolver()->reset();
  }
  void advance() override {
    world_.step(1, gallery::NutRun::kTimeStep);
    nut_on_bolt_->notice();
  }
  const gallery::NutRun& run() const override { return *nut_on_bolt_; }

  gallery::BulletWorld world_;
  std::optional<gallery::NutOnBolt> nut_on_bolt_;
};

}  // namespace octoblisk::bench
