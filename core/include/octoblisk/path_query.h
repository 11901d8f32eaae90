// Queries of one pose after another, where each is near the one before.
#pragma once

#include <optional>

#include "octoblisk/collide.h"
#include "octoblisk/depth.h"
#include "octoblisk/detail/node_pair.h"
#include "octoblisk/distance.h"
#include "octoblisk/motion.h"
#include "octoblisk/signed_distance.h"

namespace octoblisk {

/// Answers as `collide` and `distance` do, verdicts and distances alike, sooner where the poses are those of
/// a fine path: it remembers the pair of triangles that was found last, and how far apart the bodies were.
/// Which of several pairs is named may depend on the poses before, and so may the distance within the
/// options' tolerance.
///
/// Refers to the trees or surfaces, which must outlive it. Costs no more to make than a copy of a few
/// corners: one for each thread and path; the trees may be shared. Allocates nothing, but for signed
/// distances until it is warm.
class PathQuery {
 public:
  PathQuery(const ClusteredOctree& a, const ClusteredOctree& b);
  /// For signed distances too. Throws std::invalid_argument where neither surface is closed.
  PathQuery(const Surface& a, const Surface& b);

  /// A pair of triangles that meet, or none. The pair that met at the pose before is tested first, then the
  /// triangles around it.
  /// Where the last distance less the way that B's points went since is above 0, nothing more is looked at.
  std::optional<TrianglePair> collide(const Pose& b_in_a);

  /// The least distance. The last pair found is the hint, unless there is none yet: then it is the options'.
  /// Where the last distance less the way that B's points went since is no less than the upper bound, nothing
  /// is looked at.
  Clearance distance(const Pose& b_in_a, const DistanceOptions& options = {});

  /// The signed distance (signed_distance.h). Where the bodies are apart the last pair found is the hint.
  /// Throws std::logic_error where the query was made of trees.
  SignedDistance signedDistance(const Pose& b_in_a, const SignedDistanceOptions& options = {});

 private:
  bool meetBelow(const Pose& b_in_a, detail::NodePair below);
  bool provedBeyond(double distance, const Pose& b_in_a) const;

  const ClusteredOctree *a_, *b_;
  const Surface *surface_a_ = nullptr, *surface_b_ = nullptr;
  Hold hold_of_b_;
  TrianglePair witness_;
  detail::NodePair nodes_;  // whose leaves the witness is in; the roots where that is not known
  bool met_ = false;        // the witness, at the pose before
  // At this pose, the distance was proved to be no less than this.
  Pose proof_pose_;
  double proved_distance_ = 0.0;
  DepthQuery depth_;
};

}  // namespace octoblisk
