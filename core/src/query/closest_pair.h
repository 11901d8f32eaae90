// The nearest found so far in a search for the least distance: how near another must be to matter, and which
// are left to be compared exactly.
#pragma once

#include <algorithm>
#include <array>

#include "octoblisk/distance.h"
#include "query/local_pose.h"

namespace octoblisk::detail {

/// Boxes do not matter whose squared distance in single precision is above this, where what is farther than
/// `bound` does not; `size` sets the rounding.
inline float squaredLimit(double bound, double size) {
  constexpr float kFarthestRoot = 1e18f;  // its square is below that of the distance to empty boxes
  const float limit = std::min(traversalLimit(bound, size), kFarthestRoot);
  return limit * limit;
}

/// The nearest pair of triangles of two meshes.
class Nearest {
 public:
  Nearest(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a, const DistanceOptions& options)
      : a_(a), b_(b), b_in_a_(b_in_a), tolerance_(options.tolerance), bound_(options.upper_bound) {
    best_.distance = options.upper_bound;
  }

  /// Measures the pair and takes it if it is the nearest so far; `may_meet`: the two may touch. Returns true
  /// where nothing can be nearer.
  bool offer(const TrianglePair& pair, bool may_meet);

  /// Keeps the pair for later if it may be the nearest, by bounds of its distance. Returns true where nothing
  /// can be nearer.
  bool consider(const TrianglePair& pair, double least, double most);

  /// What is farther than this does not matter.
  double bound() const { return std::max(0.0, bound_ - tolerance_); }

  /// The nearest of all.
  Clearance settled();

  /// How many pairs were measured in double precision.
  std::size_t measured() const { return measured_; }

 private:
  struct Candidate {
    double least;
    TrianglePair pair;
  };
  void settleAll();

  const TriangleMesh &a_, &b_;
  const Pose& b_in_a_;
  const double tolerance_;
  double bound_;  // the distance is proved to be no more
  Clearance best_;
  std::array<Candidate, 64> candidates_;
  std::size_t count_ = 0;
  std::size_t measured_ = 0;
};

/// The triangle of a mesh that is nearest to a convex body.
class NearestToConvex {
 public:
  NearestToConvex(const TriangleMesh& a, const Convex& b, const Pose& b_in_a, const DistanceOptions& options)
      : a_(a), b_(b), b_in_a_(b_in_a), a_in_b_(b_in_a.inverse()), tolerance_(options.tolerance) {
    best_.distance = options.upper_bound;
  }

  /// Takes the triangle if it is the nearest so far. Returns true where nothing can be nearer.
  bool offer(std::uint32_t triangle);

  /// What is farther than this does not matter.
  double bound() const { return std::max(0.0, best_.distance - tolerance_); }

  const Clearance& clearance() const { return best_; }

 private:
  const TriangleMesh& a_;
  const Convex& b_;
  const Pose& b_in_a_;
  const Pose a_in_b_;
  const double tolerance_;
  Clearance best_;
};

}  // namespace octoblisk::detail
