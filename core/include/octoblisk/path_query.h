// Queries at a sequence of poses, each near the previous one.
#pragma once

#include <cstdint>
#include <optional>

#include "octoblisk/body_bounds.h"
#include "octoblisk/collide.h"
#include "octoblisk/depth.h"
#include "octoblisk/distance.h"
#include "octoblisk/signed_distance.h"

namespace octoblisk {

namespace detail {
struct NodePair;
}  // namespace detail

/// Gives the verdicts and distances of `collide` and `distance`, but faster if the poses belong to a finely
/// sampled path: it remembers the last pair of triangles found, and how far apart the bodies were. If several
/// pairs are possible, the pair returned may depend on earlier poses; so may the distance, within the
/// tolerance of the options.
///
/// Refers to the trees or surfaces, which must outlive it. Creating one costs no more than copying a few
/// corners: use one for each thread and path. Queries may share the trees. Allocates nothing, except for
/// signed distances until it is warm.
class PathQuery {
 public:
  PathQuery(const ClusteredOctree& a, const ClusteredOctree& b);
  /// For signed distances too. Throws std::invalid_argument if neither surface is closed.
  PathQuery(const Surface& a, const Surface& b);

  /// A pair of triangles that meet, or none. Tests the pair that met at the previous pose first, then the
  /// triangles around it. Tests nothing else if B's points have moved by less than the last distance.
  std::optional<TrianglePair> collide(const Pose& b_in_a);

  /// The least distance. The search starts from the pair that the last search found. The first search starts
  /// from the hint of the options. Skips the search if B cannot have come within the upper bound since the
  /// last measured distance.
  Clearance distance(const Pose& b_in_a, const DistanceOptions& options = {});

  /// The signed distance (signed_distance.h). If the bodies are apart, the last pair found is the hint.
  /// Throws std::logic_error if the query was made from trees.
  SignedDistance signedDistance(const Pose& b_in_a, const SignedDistanceOptions& options = {});

 private:
  bool meetBelow(const Pose& b_in_a, const detail::NodePair& below);
  bool provedBeyond(double distance, const Pose& b_in_a) const;

  const ClusteredOctree *a_, *b_;
  const Surface *surface_a_ = nullptr, *surface_b_ = nullptr;
  BodyBounds bounds_of_b_;
  TrianglePair witness_;
  std::uint32_t node_a_ = 0, node_b_ = 0;  // of the leaves that the witness is in; the roots if unknown
  bool met_ = false;                       // whether the witness met at the previous pose
  // At this pose, the distance was proved to be at least this.
  Pose proof_pose_;
  double proved_distance_ = 0.0;
  DepthQuery depth_;
};

}  // namespace octoblisk
