// The state of a search for the least distance: the nearest pair so far, the distance above which others are
// irrelevant, and the candidates that are left to be compared exactly.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "geometry/triangle_convex.h"
#include "octoblisk/distance.h"
#include "query/local_pose.h"

namespace octoblisk::detail {

/// The squared box distance, in single precision, above which boxes are irrelevant if distances above `bound`
/// are. `size` determines the rounding.
inline float squaredLimit(double bound, double size) {
  constexpr float kFarthestRoot = 1e18f;  // its square is below that of the distance to empty boxes
  const float limit = std::min(traversalLimit(bound, size), kFarthestRoot);
  constexpr float kSubnormal = 0x1p-147f;  // above the rounding of subnormal squares
  return limit * limit + kSubnormal;
}

/// Bounds of the distances of eight pairs.
struct DistanceBounds8 {
  std::array<float, kLanes> least, most;
};

/// A search for the nearest pair of triangles of two meshes.
class DistanceSearch {
 public:
  DistanceSearch(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a,
                 const DistanceOptions& options)
      : a_(a), b_(b), b_in_a_(b_in_a), tolerance_(options.tolerance), bound_(options.upper_bound) {
    best_.distance = options.upper_bound;
  }

  /// Measures the pair and keeps it if it is the nearest so far. `may_meet`: the triangles may touch. Returns
  /// true if nothing can be nearer.
  bool offer(const TrianglePair& pair, bool may_meet);

  /// Keeps those of the pairs that may be nearest. No pair meets; `bounds` are those of their distances. If
  /// one is clearly nearer than all before, measures it at once. Returns true if nothing can be nearer.
  bool consider(std::span<const TrianglePair> pairs, const DistanceBounds8& bounds);

  /// Whether a pair has been measured.
  bool hasPair() const { return best_.found(); }
  /// The unit vector from A to B between the nearest points so far; zero if no pair has been measured.
  const Eigen::Vector3f& direction() const { return direction_; }

  /// Distances above this are irrelevant.
  double bound() const { return std::max(0.0, bound_ - tolerance_); }

  /// The nearest pair of all.
  Clearance settled();

  /// The number of pairs that were measured in double precision.
  std::size_t measured() const { return measured_; }

 private:
  struct Candidate {
    double least;
    TrianglePair pair;
  };
  void keep(const TrianglePair& pair, double least);
  void settleAll();

  const TriangleMesh &a_, &b_;
  const Pose& b_in_a_;
  const double tolerance_;
  double bound_;  // an upper bound of the distance
  Clearance best_;
  Eigen::Vector3f direction_ = Eigen::Vector3f::Zero();
  std::array<Candidate, 64> candidates_;
  std::size_t count_ = 0;
  std::size_t measured_ = 0;
};

/// A search for the triangle of a mesh that is nearest to a convex body.
class ConvexDistanceSearch {
 public:
  ConvexDistanceSearch(const TriangleMesh& a, const Convex& b, const Pose& b_in_a,
                       const DistanceOptions& options)
      : a_(a), b_(b, b_in_a), tolerance_(options.tolerance) {
    best_.distance = options.upper_bound;
  }

  /// Keeps the triangle if it is the nearest so far. Returns true if nothing can be nearer.
  bool offer(std::uint32_t triangle);

  /// Distances above this are irrelevant.
  double bound() const { return std::max(0.0, best_.distance - tolerance_); }

  const Clearance& clearance() const { return best_; }

 private:
  const TriangleMesh& a_;
  const PosedConvex b_;
  const double tolerance_;
  Clearance best_;
};

}  // namespace octoblisk::detail
