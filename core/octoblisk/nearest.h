// The search for the nearest pair of triangles: how near another must be to matter, and which are left to be
// compared exactly.
#pragma once

#include <array>

#include "octoblisk/distance.h"

namespace octoblisk {

class Nearest {
 public:
  Nearest(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a, const DistanceOptions& options)
      : a_(a), b_(b), b_in_a_(b_in_a), tolerance_(options.tolerance), bound_(options.upper_bound) {
    best_.distance = options.upper_bound;
  }

  /// Measures the pair and takes it if it is the nearest so far; `may_meet`: the two may touch. Returns true
  /// where nothing can be nearer.
  bool offer(const TrianglePair& pair, bool may_meet);

  /// Keeps the pair for later if it may be the nearest, by its distance in single precision, which may be
  /// off by `rounding`. Returns true where nothing can be nearer.
  bool consider(const TrianglePair& pair, float distance, float rounding);

  /// The size of the bodies, which sets how far the distances of boxes may be off.
  void setSize(double size) { size_ = size; }

  /// Triangles farther apart than this do not matter.
  float bound() const {
    return static_cast<float>(std::min((bound_ - tolerance_) * (1.0 + 0x1p-20), kFarthest));
  }
  /// Nor do boxes whose squared distance in single precision is above this.
  float squaredLimit() const;

  /// The nearest of all.
  Clearance settled();

 private:
  struct Candidate {
    double least;
    TrianglePair pair;
  };
  void settleAll();

  static constexpr double kFarthest = 1e18;  // its square is below that of the distance to empty boxes

  const TriangleMesh &a_, &b_;
  const Pose& b_in_a_;
  const double tolerance_;
  double size_ = 0.0;
  double bound_;  // the distance is proved to be no more
  Clearance best_;
  std::array<Candidate, 64> candidates_;
  std::size_t count_ = 0;
};

}  // namespace octoblisk
