// A nut that runs down its bolt in the world of some physics engine, and its rating by the closed form.
#pragma once

#include <algorithm>
#include <numbers>

#include "contender.h"
#include "gallery/nut_run.h"

namespace octoblisk::bench {

class RatedNut : public AssemblyQuery {
 public:
  void restart() final {
    putBack();
    steps_ = 0;
    off_helix_ = 0.0;
  }
  void step() final {
    advance();
    ++steps_;
    off_helix_ = std::max(off_helix_, 1e3 * run().offHelix());
  }
  double sunk() const final { return 1e3 * run().sunk(); }
  double expectedSunk() const final {
    const double time = steps_ * gallery::NutRun::kTimeStep;
    return 1e3 * 0.5 * run().acceleration() * time * time;
  }
  double turns() const final { return -0.5 / std::numbers::pi * run().turned(); }
  double offHelix() const final { return off_helix_; }
  double play() const final { return 1e3 * shapes::axialPlay(kNutThread); }

 protected:
  /// Puts the nut at its start, and tells its run.
  virtual void putBack() = 0;
  /// Takes a step, and tells the nut's run its pose.
  virtual void advance() = 0;
  virtual const gallery::NutRun& run() const = 0;

 private:
  int steps_ = 0;
  double off_helix_ = 0.0;
};

}  // namespace octoblisk::bench
