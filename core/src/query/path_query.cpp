#include "octoblisk/path_query.h"

#include <cmath>
#include <stdexcept>

#include "geometry/triangle_pair.h"
#include "query/collide_below.h"
#include "query/local_pose.h"
#include "query/signed_distance.h"

namespace octoblisk {

using namespace detail;

PathQuery::PathQuery(const ClusteredOctree& a, const ClusteredOctree& b) : a_(&a), b_(&b), bounds_of_b_(b) {}

PathQuery::PathQuery(const Surface& a, const Surface& b) : PathQuery(a.tree(), b.tree()) {
  if (!a.isClosed() && !b.isClosed()) {
    throw std::invalid_argument(
        "PathQuery: a signed distance needs at least one closed surface, but both are open");
  }
  surface_a_ = &a;
  surface_b_ = &b;
}

std::optional<TrianglePair> PathQuery::collide(const Pose& b_in_a) {
  if (met_ && b_in_a.isFinite()) {
    if (intersects(a_->mesh(), b_->mesh(), b_in_a, witness_)) return witness_;
    if (node_a_ != 0 && meetBelow(b_in_a, {node_a_, node_b_})) return witness_;
  }
  met_ = !provedBeyond(0.0, b_in_a) && meetBelow(b_in_a, NodePair());
  return met_ ? std::optional(witness_) : std::nullopt;
}

/// Searches for a pair that meets below two nodes, and keeps it.
bool PathQuery::meetBelow(const Pose& b_in_a, const NodePair& below) {
  const std::optional<MeetingPair> hit = collideBelow(treeOf(*a_), treeOf(*b_), b_in_a, below);
  if (!hit) return false;
  witness_ = hit->triangles;
  node_a_ = hit->nodes.a;
  node_b_ = hit->nodes.b;
  return true;
}

Clearance PathQuery::distance(const Pose& b_in_a, const DistanceOptions& options) {
  if (provedBeyond(options.upper_bound, b_in_a)) return {.distance = options.upper_bound};
  DistanceOptions hinted = options;
  if (witness_.a != kNoTriangle) hinted.hint = witness_;
  Clearance found = octoblisk::distance(*a_, *b_, b_in_a, hinted);
  if (found.found()) {
    witness_ = found.triangles();
    node_a_ = node_b_ = 0;
  }
  met_ = found.found() && found.distance == 0.0;
  proof_pose_ = b_in_a;
  proved_distance_ = std::isfinite(found.distance) ? found.distance - options.tolerance : 0.0;
  return found;
}

SignedDistance PathQuery::signedDistance(const Pose& b_in_a, const SignedDistanceOptions& options) {
  if (surface_a_ == nullptr) {
    throw std::logic_error(
        "PathQuery: a signed distance needs surfaces: construct the query from two Surface objects");
  }
  return detail::signedDistance(*surface_a_, *surface_b_, b_in_a, options, distance(b_in_a), depth_);
}

/// Whether the last distance proves that the bodies are farther apart than this, despite the rounding of
/// distances and poses.
bool PathQuery::provedBeyond(double distance, const Pose& b_in_a) const {
  if (!(proved_distance_ > distance)) return false;
  const double size =
      sizeOf(treeOf(*a_), treeOf(*b_)) + proof_pose_.translation.norm() + b_in_a.translation.norm();
  return proved_distance_ - bounds_of_b_.displacement(proof_pose_, b_in_a) >
         distance + kDistanceRounding * size;
}

}  // namespace octoblisk
