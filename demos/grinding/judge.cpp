#include "grinding/judge.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "grinding/lift.h"
#include "grinding/pose_clearances.h"
#include "octoblisk/path_query.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

// The cache is reset after this many poses, so the answers do not depend on the number of threads.
constexpr std::size_t kPosesPerCache = 64;
constexpr double kMarginOfMotions = 0.5;  // fraction of the poses' margin

VerdictRules withBlades(VerdictRules rules, std::span<const int> blade_of_triangle) {
  rules.blade_count = blade_of_triangle.empty() ? 0 : *std::ranges::max_element(blade_of_triangle);
  return rules;
}

bool isSame(const Pose& a, const Pose& b) {
  return a.rotation == b.rotation && a.translation == b.translation;
}

}  // namespace

std::shared_ptr<PartDepths> depthsUnder(const VerdictRules& rules,
                                        std::shared_ptr<const ClusteredOctree> blisk,
                                        std::vector<ToolPart> parts, int threads,
                                        std::span<const Fixture> fixtures) {
  std::vector<double> limits;
  for (std::size_t part = 0; part < parts.size(); ++part) limits.push_back(rules.maxDepth(part));
  return std::make_shared<PartDepths>(std::move(blisk), std::move(parts), std::move(limits), threads,
                                      fixtures);
}

struct Judge::PoseCache {
  explicit PoseCache(const Judge& judge) : touched(judge.parts_.size()), deep_corners(judge.parts_.size()) {
    for (std::size_t part = 0; part < judge.parts_.size(); ++part) {
      const ClusteredOctree& tree = *judge.parts_[part].tree;
      const Obstacle* const obstacle = judge.obstacles_.of(part);
      forbidden.push_back(obstacle ? std::optional<PathQuery>(std::in_place, obstacle->tree(), tree)
                                   : std::nullopt);
      if (judge.obstacles_.mayTouchAny(part)) touched[part].emplace(*judge.blisk_, tree);
    }
  }

  std::vector<std::optional<PathQuery>> forbidden;  // per part: with everything that it must not touch
  std::vector<std::optional<PathQuery>> touched;    // per part that may touch: with the blisk
  std::vector<std::optional<std::uint32_t>> deep_corners;
  std::size_t last_hit = 0;  // the part that was blocked last
};

Judge::Judge(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
             std::span<const int> blade_of_triangle, VerdictRules rules, int threads,
             std::span<const Fixture> fixtures, std::shared_ptr<PartDepths> depths)
    : blisk_(std::move(blisk)),
      parts_(std::move(parts)),
      rules_(withBlades(std::move(rules), blade_of_triangle)),
      threads_(threads),
      obstacles_(blisk_, blade_of_triangle, parts_.size(), rules_, fixtures),
      depths_(depths ? std::move(depths) : depthsUnder(rules_, blisk_, parts_, threads, fixtures)),
      motion_check_(blisk_, parts_, rules_, obstacles_, *depths_, threads) {}

Judge::~Judge() = default;

void Judge::measureDepths(std::span<PoseReport> poses) {
  std::vector<Pose> places;
  for (const PoseReport& pose : poses) places.push_back(pose.tool_in_blisk);
  auto found = depths_->measure(places);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    PoseReport& pose = poses[i];
    pose.depths = std::move(found[i]);
    pose.depth_blades.clear();
    for (const PartDepth& deepest : pose.depths) {
      pose.depth_blades.push_back(bodyOfTriangle()[deepest.triangle_of_blisk]);
    }
  }
}

void Judge::setVerdicts(std::span<PoseReport> poses) const { demos::setVerdicts(poses, rules_); }

void Judge::measureClearances(std::span<PoseReport> poses, const Pose* before, const Pose* after) const {
  demos::measureClearances(obstacles_, parts_, poses, before, after, threads_);
}

void Judge::checkMotions(std::span<PoseReport> poses) {
  std::vector<std::size_t> led_to;
  for (std::size_t i = 1; i < poses.size(); ++i) led_to.push_back(i);
  std::vector<MotionReport> found = motion_check_.check(poses, led_to, kMotionTolerance);
  for (std::size_t m = 0; m < found.size(); ++m) poses[led_to[m]].motion = std::move(found[m]);
}

std::vector<PoseState> Judge::statesOf(std::span<const Pose> tool_in_blisk) {
  std::vector<PoseState> states(tool_in_blisk.size());
  const std::size_t runs = (states.size() + kPosesPerCache - 1) / kPosesPerCache;
  parallelFor(runs, threads_, [&](std::size_t index, std::size_t thread) {
    PoseCache cache(*this);
    const std::size_t end = std::min(states.size(), (index + 1) * kPosesPerCache);
    for (std::size_t i = index * kPosesPerCache; i < end; ++i) {
      states[i] = stateAt(tool_in_blisk[i], cache, thread);
    }
  });
  return states;
}

PoseState Judge::stateAt(const Pose& pose, PoseCache& cache, std::size_t thread) {
  PoseState state;
  // The part that was blocked at the last pose is likely to be blocked again.
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const std::size_t part = (cache.last_hit + k) % parts_.size();
    state.obstacle = hitBy(part, pose, cache);
    if (!state.obstacle) continue;
    cache.last_hit = part;
    return state;
  }
  std::vector<std::pair<std::size_t, TrianglePair>> touches;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const auto pair = cache.touched[part] ? cache.touched[part]->collide(pose) : std::nullopt;
    if (pair) {
      touches.emplace_back(part, *pair);
    }
    if ((!pair && isInside(part, pose)) || depths_->isInFixture(part, pose)) {
      state.obstacle = Obstruction{part, 0, false, true};
      return state;
    }
  }
  for (const auto& [part, pair] : touches) {
    state.grinds = true;
    if (!depths_->isBeyond(part, pose, pair, cache.deep_corners[part], thread)) continue;
    state.obstacle = Obstruction{part, bodyOfTriangle()[pair.a], true, false};
    return state;
  }
  return state;
}

/// A forbidden touch of the part, or a clearance below the margin.
std::optional<Obstruction> Judge::hitBy(std::size_t part, const Pose& pose, PoseCache& cache) const {
  if (!cache.forbidden[part]) return std::nullopt;
  std::uint32_t triangle = kNoTriangle;
  if (rules_.near_miss > 0.0) {
    const Clearance clearance = cache.forbidden[part]->distance(pose, {.upper_bound = rules_.near_miss});
    if (clearance.found()) triangle = clearance.triangle_a;
  } else if (const auto pair = cache.forbidden[part]->collide(pose)) {
    triangle = pair->a;
  }
  if (triangle == kNoTriangle) return std::nullopt;
  return Obstruction{part, bodyOfTriangle()[obstacles_.of(part)->triangleOfAll(triangle)], false, false};
}

/// For a part that does not touch the blisk: true if any of its surface is in the blisk, or the reverse.
bool Judge::isInside(std::size_t part, const Pose& pose) const {
  return areNested(depths_->blisk(), depths_->partSurface(part), pose);
}

std::vector<std::optional<Obstruction>> Judge::obstaclesOf(std::span<const MotionEnds> motions) {
  std::vector<std::size_t> led_to;
  const std::vector<PoseReport> ends = endsOf(motions, led_to);
  const double clearance = std::max(kMarginOfMotions * rules_.near_miss, kMotionTolerance);
  std::vector<std::optional<Obstruction>> obstacles;
  for (const MotionReport& motion : motion_check_.check(ends, led_to, clearance)) {
    using Outcome = MotionReport::Outcome;
    obstacles.push_back(std::nullopt);
    if (!motion.hasFinding()) continue;
    obstacles.back() =
        Obstruction{motion.at.part, motion.at.blade, motion.outcome == Outcome::too_deep, false};
  }
  return obstacles;
}

/// The end poses of motions, with the data that MotionCheck needs. A shared end of consecutive motions is one
/// pose.
std::vector<PoseReport> Judge::endsOf(std::span<const MotionEnds> motions, std::vector<std::size_t>& led_to) {
  std::vector<PoseReport> ends;
  const auto add = [&](const Pose& pose) { ends.emplace_back().tool_in_blisk = pose; };
  for (const MotionEnds& motion : motions) {
    if (ends.empty() || !isSame(ends.back().tool_in_blisk, motion.from)) add(motion.from);
    add(motion.to);
    led_to.push_back(ends.size() - 1);
  }
  std::vector<std::size_t> parts;
  std::vector<Pose> places;
  std::vector<PoseReport*> reports;
  for (PoseReport& end : ends) {
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      if (!obstacles_.mayTouchAny(part)) continue;
      parts.push_back(part);
      places.push_back(end.tool_in_blisk);
      reports.push_back(&end);
    }
  }
  const auto depths = depths_->measure(parts, places);
  for (std::size_t k = 0; k < depths.size(); ++k) {
    if (depths[k]) reports[k]->depths.push_back(*depths[k]);
  }
  measureClearances(ends, nullptr, nullptr);
  return ends;
}

}  // namespace octoblisk::demos
