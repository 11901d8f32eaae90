#include "grinding/pose_judge.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "grinding/fine_features.h"
#include "grinding/lift.h"
#include "models/triangle_tree.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/containment.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr std::size_t kPosesOfTrail = 64;  // then memory begins afresh, whatever the number of threads
constexpr int kMostClimbs = 32;            // of a climb
// As PartDepths measures.
constexpr double kJudgedPart = 0.01;
constexpr double kLeastJudged = 1e-4;     // mm
constexpr double kLeastFineLimit = 0.01;  // mm
constexpr double kJudgedFiner = 0.1;      // where the limit is between the bounds
constexpr double kFirstPart = 0.5;        // part of the limit: of the first question

std::shared_ptr<const ClusteredOctree> treeOfSome(const TriangleMesh& mesh,
                                                  const std::vector<std::uint32_t>& triangles) {
  if (triangles.empty()) return nullptr;
  std::vector<TriangleMesh::Indices> some;
  for (const std::uint32_t triangle : triangles) some.push_back(mesh.triangles()[triangle]);
  return treeOfTriangles(mesh, std::move(some));
}

}  // namespace

struct PoseJudge::Trail {
  explicit Trail(const PoseJudge& judge) {
    for (std::size_t part = 0; part < judge.parts_.size(); ++part) {
      const ClusteredOctree* forbidden = judge.forbiddenTo(part);
      queries.push_back(forbidden
                            ? std::optional<PathQuery>(std::in_place, *forbidden, *judge.parts_[part].tree)
                            : std::nullopt);
    }
    if (judge.ground_blade_) {
      grinding.emplace(*judge.ground_blade_, *judge.parts_[judge.rules_.grinding_part].tree);
    }
  }

  std::vector<std::optional<PathQuery>> queries;  // of each part with what it must keep off
  std::optional<PathQuery> grinding;              // of the belt with the ground blade
  std::size_t last_hit = 0;                       // the part that was in the way
  std::optional<std::uint32_t> deep_corner;       // of the belt, that was too deep
};

struct PoseJudge::Worker {
  DepthQuery depth_query;
  std::vector<Contact> contacts;
  std::vector<TrianglePair> touching;
  std::vector<char> seen;                // of the blisk's triangles
  std::vector<std::uint32_t> swallowed;  // by the belt, in whole or part
};

PoseJudge::PoseJudge(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                     std::vector<int> blade_of_triangle, const ReachRules& rules, int threads)
    : blisk_(std::move(blisk)),
      parts_(std::move(parts)),
      blade_of_triangle_(std::move(blade_of_triangle)),
      rules_(rules),
      blisk_surface_(*blisk_),
      workers_(static_cast<std::size_t>(threadCount(threads))) {
  if (blade_of_triangle_.size() != blisk_->mesh().triangleCount()) {
    throw std::invalid_argument("the blades are not those of this mesh");
  }
  for (const ToolPart& part : parts_) part_surfaces_.emplace_back(*part.tree);
  if (rules_.ground_blade == 0) return;
  std::vector<std::uint32_t> ground;
  for (std::uint32_t t = 0; t < blade_of_triangle_.size(); ++t) {
    (blade_of_triangle_[t] == rules_.ground_blade ? ground : rest_triangles_).push_back(t);
  }
  ground_blade_ = treeOfSome(blisk_->mesh(), ground);
  rest_ = treeOfSome(blisk_->mesh(), rest_triangles_);
  if (!blisk_surface_.isClosed()) return;
  fine_triangles_ = fineFeatures(blisk_surface_, std::max(rules_.max_depth, kLeastFineLimit), threads);
}

PoseJudge::~PoseJudge() = default;

int PoseJudge::threads() const { return static_cast<int>(workers_.size()); }

const ClusteredOctree* PoseJudge::forbiddenTo(std::size_t part) const {
  const bool grinds = part == rules_.grinding_part && rules_.ground_blade != 0;
  return grinds ? rest_.get() : blisk_.get();
}

std::uint32_t PoseJudge::numberInBlisk(std::size_t part, std::uint32_t triangle) const {
  return forbiddenTo(part) == blisk_.get() ? triangle : rest_triangles_[triangle];
}

std::vector<PoseState> PoseJudge::judge(std::span<const Pose> tool_in_blisk) {
  std::vector<PoseState> states(tool_in_blisk.size());
  const std::size_t trails = (states.size() + kPosesOfTrail - 1) / kPosesOfTrail;
  parallelFor(trails, threads(), [&](std::size_t index, std::size_t thread) {
    Trail trail(*this);
    const std::size_t end = std::min(states.size(), (index + 1) * kPosesOfTrail);
    for (std::size_t i = index * kPosesOfTrail; i < end; ++i) {
      states[i] = stateAt(tool_in_blisk[i], trail, workers_[thread]);
    }
  });
  return states;
}

PoseState PoseJudge::stateAt(const Pose& pose, Trail& trail, Worker& worker) const {
  PoseState state;
  // The part that was in the way a moment ago is likely to be so still.
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const std::size_t part = (trail.last_hit + k) % parts_.size();
    state.obstacle = hitBy(part, pose, trail);
    if (!state.obstacle) continue;
    trail.last_hit = part;
    return state;
  }
  const auto touching = trail.grinding ? trail.grinding->collide(pose) : std::nullopt;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (touching && part == rules_.grinding_part) continue;
    if (!isInside(part, pose)) continue;
    state.obstacle = Hindrance{part, 0, false, true};
    return state;
  }
  if (!touching) return state;
  state.grinds = true;
  if (isTooDeep(pose, touching->b, trail, worker)) {
    state.obstacle = Hindrance{rules_.grinding_part, rules_.ground_blade, true, false};
  }
  return state;
}

/// A touch that no part may have, or a clearance below the margin.
std::optional<Hindrance> PoseJudge::hitBy(std::size_t part, const Pose& pose, Trail& trail) const {
  if (!trail.queries[part]) return std::nullopt;
  std::uint32_t triangle = kNoTriangle;
  if (rules_.margin > 0.0) {
    const Clearance clearance = trail.queries[part]->distance(pose, {.upper_bound = rules_.margin});
    if (clearance.found()) triangle = clearance.triangle_a;
  } else if (const auto pair = trail.queries[part]->collide(pose)) {
    triangle = pair->a;
  }
  if (triangle == kNoTriangle) return std::nullopt;
  return Hindrance{part, blade_of_triangle_[numberInBlisk(part, triangle)], false, false};
}

/// Of a part that does not touch the blisk: whether any of its surface is in the blisk, or the reverse.
bool PoseJudge::isInside(std::size_t part, const Pose& pose) const {
  return blisk_surface_.isClosed() && isNested(blisk_surface_, part_surfaces_[part], pose);
}

/// Whether the belt, which touches the ground blade and nothing else, is beyond the greatest depth: what
/// PartDepths would say, but by coarser questions first.
bool PoseJudge::isTooDeep(const Pose& pose, std::uint32_t touching_triangle, Trail& trail,
                          Worker& worker) const {
  const double limit = rules_.max_depth;
  const octoblisk::Surface& belt = part_surfaces_[rules_.grinding_part];
  if (!blisk_surface_.isClosed()) {
    contacts(*blisk_, belt.tree(), pose, 0.0, worker.contacts);
    return std::ranges::any_of(worker.contacts,
                               [&](const Contact& contact) { return -contact.distance > limit; });
  }
  const Vec3 off = pose.translation - closestPoint(*ground_blade_, pose.translation)->point;
  if (!off.isZero() && partsWhenLifted(blisk_surface_, belt, pose, off.normalized(), limit)) return false;
  if (climbsBeyond(pose, touching_triangle, trail)) return true;
  const auto ask = [&](double tolerance) {
    return worker.depth_query.deepest(blisk_surface_, belt, pose, tolerance);
  };
  const double tolerance = std::max(kJudgedPart * limit, kLeastJudged);
  const GougeDepth coarse = ask(std::max(kFirstPart * limit, kLeastJudged));
  if (coarse.depth > limit + tolerance) return true;
  if (coarse.upper_bound > limit) {
    GougeDepth found = ask(tolerance);
    if (found.depth <= limit && found.upper_bound > limit) found = ask(kJudgedFiner * tolerance);
    if (found.depth > limit) return true;
  }
  return belt.isClosed() && isFineFeatureTooDeep(pose, worker);
}

/// Whether a point of the blisk's fine features is too deep in the belt. Of these only triangles count that
/// meet the belt's surface, or that hang together with such inside the belt.
bool PoseJudge::isFineFeatureTooDeep(const Pose& pose, Worker& worker) const {
  const double limit = std::max(rules_.max_depth, kLeastFineLimit);
  const octoblisk::Surface& belt = part_surfaces_[rules_.grinding_part];
  const Pose blisk_in_belt = pose.inverse();
  // No feature is deeper than the deepest point.
  const GougeDepth deepest =
      worker.depth_query.deepest(belt, blisk_surface_, blisk_in_belt, kFirstPart * limit);
  if (deepest.upper_bound <= limit) return false;
  const auto is_in_belt = [&](std::uint32_t corner) {
    return locate(belt, blisk_in_belt * blisk_surface_.position(corner)) == PointLocation::inside;
  };
  worker.seen.resize(blade_of_triangle_.size(), 0);
  worker.swallowed.clear();
  const auto add = [&](std::uint32_t triangle) {
    if (worker.seen[triangle]) return;
    worker.seen[triangle] = 1;
    worker.swallowed.push_back(triangle);
  };
  touchingPairs(*blisk_, belt.tree(), pose, worker.touching);
  for (const TrianglePair& pair : worker.touching) add(pair.a);
  for (std::size_t k = 0; k < blisk_surface_.partCount(); ++k) {  // a part may be wholly in the belt
    const std::uint32_t corner = blisk_surface_.cornerOfPart(k);
    if (is_in_belt(corner)) add(blisk_surface_.star(corner).front());
  }
  std::set<std::uint32_t> known_corners;
  for (std::size_t next = 0; next < worker.swallowed.size(); ++next) {
    for (const std::uint32_t corner : blisk_surface_.corners(worker.swallowed[next])) {
      if (!known_corners.insert(corner).second || !is_in_belt(corner)) continue;
      for (const std::uint32_t triangle : blisk_surface_.star(corner)) add(triangle);
    }
  }
  for (const std::uint32_t triangle : worker.swallowed) worker.seen[triangle] = 0;
  std::erase_if(worker.swallowed, [&](std::uint32_t triangle) {
    return !std::ranges::binary_search(fine_triangles_, triangle);
  });
  return deepestBeyond(blisk_->mesh(), worker.swallowed, belt, blisk_in_belt, limit).has_value();
}

double PoseJudge::depthOfCorner(const Pose& pose, std::uint32_t corner) const {
  const Vec3 point = pose * part_surfaces_[rules_.grinding_part].position(corner);
  if (locate(blisk_surface_, point) != PointLocation::inside) return 0.0;
  return closestPoint(*blisk_, point).value().distance;
}

/// From a triangle of the belt that touches, corner by corner to where it is deeper: true where one is deeper
/// than the limit beyond all tolerances, false where it is not known.
bool PoseJudge::climbsBeyond(const Pose& pose, std::uint32_t touching_triangle, Trail& trail) const {
  const octoblisk::Surface& belt = part_surfaces_[rules_.grinding_part];
  const double beyond = (1.0 + kJudgedPart) * rules_.max_depth + kLeastJudged;
  if (trail.deep_corner && depthOfCorner(pose, *trail.deep_corner) > beyond) return true;
  double deepest = -1.0;
  std::uint32_t at = 0;
  const auto look = [&](std::uint32_t triangle) {
    bool rises = false;
    for (const std::uint32_t corner : belt.corners(triangle)) {
      if (corner == at && deepest >= 0.0) continue;
      const double depth = depthOfCorner(pose, corner);
      if (depth <= deepest) continue;
      deepest = depth;
      at = corner;
      rises = true;
    }
    return rises;
  };
  look(touching_triangle);
  for (int step = 0; step < kMostClimbs && deepest <= beyond; ++step) {
    bool rises = false;
    for (const std::uint32_t triangle : belt.star(at)) {
      rises = look(triangle);
      if (rises) break;
    }
    if (!rises) return false;
  }
  if (deepest <= beyond) return false;
  trail.deep_corner = at;
  return true;
}

}  // namespace octoblisk::demos
