// The gallery's pile of concave bodies, for the contenders whose concave bodies can move.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "contender.h"
#include "gallery/concave_pile.h"

namespace octoblisk::bench {

class ConcavePileQuery : public PileQuery {
 public:
  void restart() override {
    for (std::size_t k = 0; k < pile_->size(); ++k) {
      btRigidBody& body = pile_->body(k);
      pile_->world()->removeRigidBody(&body);  // also removes its pairs
      body.setWorldTransform(starts_[k]);
      body.setInterpolationWorldTransform(starts_[k]);
      body.setLinearVelocity(btVector3(0, 0, 0));
      body.setAngularVelocity(btVector3(0, 0, 0));
      body.clearForces();
      pile_->world()->addRigidBody(&body);
    }
    pile_->world()->getConstraintSolver()->reset();
  }
  void step() override { pile_->step(); }
  int bodies() const override { return static_cast<int>(pile_->size()); }
  int fallen() const override { return pile_->fallen(); }
  double depth() const override {
    const auto [in_floor, in_bodies] = pile_->depths();
    return std::max(in_floor, in_bodies);
  }

 protected:
  /// Drops 64 bodies that never sleep.
  void start(const gallery::MakeShape& make_shape) {
    pile_ = std::make_unique<gallery::ConcavePile>(64, 1, make_shape);
    for (std::size_t k = 0; k < pile_->size(); ++k) {
      pile_->body(k).setActivationState(DISABLE_DEACTIVATION);
      starts_.push_back(pile_->body(k).getWorldTransform());
    }
  }
  /// Must be called before the shapes' meshes are destroyed.
  void stop() { pile_.reset(); }
  btCollisionDispatcher* dispatcher() { return &pile_->world().dispatcher(); }

 private:
  std::unique_ptr<gallery::ConcavePile> pile_;
  std::vector<btTransform> starts_;
};

}  // namespace octoblisk::bench
