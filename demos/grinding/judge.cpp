#include "grinding/judge.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "grinding/depth_proof.h"
#include "octoblisk/batch.h"
#include "octoblisk/motion.h"
#include "octoblisk/path_query.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

// The cache is reset after this many poses, so the answers do not depend on the number of threads.
constexpr std::size_t kPosesPerCache = 64;
constexpr double kMarginOfMotions = 0.5;  // fraction of the poses' margin

/// Clearances are measured up to this multiple of a motion's path length, so that they can prove the motion
/// free; the excess over 1 covers rounding.
constexpr double kOfMotion = 1.001;

template <typename Step>
void addTime(double& seconds, const Step& step) {
  const auto start = std::chrono::steady_clock::now();
  step();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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
  explicit PoseCache(const Judge& judge)
      : forbidden(judge.forbiddenQueries()), touched(judge.parts_.size()), deep_corners(judge.parts_.size()) {
    for (std::size_t part = 0; part < judge.parts_.size(); ++part) {
      if (judge.obstacles_.mayTouchAny(part)) touched[part].emplace(*judge.blisk_, *judge.parts_[part].tree);
    }
  }

  std::vector<std::optional<PathQuery>> forbidden;
  std::vector<std::optional<PathQuery>> touched;  // per part that may touch: with the blisk
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
      motion_check_(blisk_, parts_, rules_, obstacles_, *depths_, threads),
      bodies_(rules_.blade_count + 1 + static_cast<int>(fixtures.size())) {}

Judge::~Judge() = default;

/// Per part: with everything that it must not touch.
std::vector<std::optional<PathQuery>> Judge::forbiddenQueries() const {
  std::vector<std::optional<PathQuery>> queries(parts_.size());
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (const Obstacle* const obstacle = obstacles_.of(part)) {
      queries[part].emplace(obstacle->tree(), *parts_[part].tree);
    }
  }
  return queries;
}

void Judge::judgeNext(std::span<const Pose> path, std::size_t end, bool motions,
                      std::vector<PoseReport>& judged, JudgeTimes& times) {
  for (int thread = static_cast<int>(cells_.size()); thread < threadCount(threads_); ++thread) {
    cells_.push_back(std::make_unique<GrindingCell>(blisk_, parts_, reaches(), &obstacles_));
  }
  const std::size_t begin = judged.size();
  judged.resize(end);
  const std::span<PoseReport> poses = std::span(judged).subspan(begin);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].tool_in_blisk = path[begin + i];
  addTime(times.contacts, [&] { findTouches(poses); });
  addTime(times.depths, [&] { measureDepths(poses); });
  for (PoseReport& pose : poses) setVerdicts(pose, rules_);
  addTime(times.clearances, [&] { measureClearances(path, begin, poses); });
  if (!motions) return;
  addTime(times.motions, [&] {
    std::vector<std::size_t> led_to;
    for (std::size_t p = std::max<std::size_t>(begin, 1); p < end; ++p) led_to.push_back(p);
    std::vector<MotionReport> found = motion_check_.check(judged, led_to, kMotionTolerance);
    for (std::size_t m = 0; m < found.size(); ++m) judged[led_to[m]].motion = std::move(found[m]);
  });
}

/// For each part, the greatest distance at which any body is a near miss.
std::vector<double> Judge::reaches() const {
  std::vector<double> reaches(parts_.size(), 0.0);
  for (std::size_t part = 0; part < reaches.size(); ++part) {
    for (int body = 0; body < bodies_; ++body) {
      if (!rules_.allows(part, body)) reaches[part] = std::max(reaches[part], rules_.margin(part, body));
    }
  }
  return reaches;
}

void Judge::findTouches(std::span<PoseReport> poses) {
  parallelFor(poses.size(), threads_, [&](std::size_t i, std::size_t worker) {
    poses[i].touches = reduceContacts(cells_[worker]->touchesAt(poses[i].tool_in_blisk), bodyOfTriangle());
  });
}

void Judge::measureDepths(std::span<PoseReport> poses) {
  std::vector<Pose> places;
  for (const PoseReport& pose : poses) places.push_back(pose.tool_in_blisk);
  auto found = depths_->measure(places);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].depths = std::move(found[i]);
    for (PartDepth& deepest : poses[i].depths) deepest.blade = bodyOfTriangle()[deepest.triangle_of_blisk];
  }
}

/// Sets `clearance` of the poses, path[begin] and those after it, and as many `part_clearances` as the
/// motions to and from them need.
void Judge::measureClearances(std::span<const Pose> path, std::size_t begin,
                              std::span<PoseReport> poses) const {
  parallelForChunks(poses.size(), kPosesAtOnce, threads_, [&](std::size_t first, std::size_t end) {
    auto queries = forbiddenQueries();
    for (std::size_t i = first; i < end; ++i) {
      PoseReport& pose = poses[i];
      const std::size_t at = begin + i;
      const Motion there(path[at > 0 ? at - 1 : at], path[at]),
          on(path[at], path[at + 1 < path.size() ? at + 1 : at]);
      constexpr double kFar = std::numeric_limits<double>::infinity();
      pose.part_clearances.assign(parts_.size(), kFar);
      double least = kFar;
      for (std::size_t part = 0; part < parts_.size(); ++part) {
        if (!queries[part]) continue;
        const ClusteredOctree& tree = *parts_[part].tree;
        const double of_motions = kOfMotion * std::max(there.lengthBound(tree), on.lengthBound(tree));
        Clearance found = queries[part]->distance(path[at], {.upper_bound = std::max(least, of_motions)});
        pose.part_clearances[part] = found.distance;
        if (!found.found() || found.distance >= least) continue;
        least = found.distance;
        found.triangle_a = obstacles_.of(part)->triangleOfAll(found.triangle_a);
        pose.clearance = touchAt(part, bodyOfTriangle()[found.triangle_a], found);
      }
    }
  });
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
  std::vector<Pose> ends;  // a shared end of consecutive motions is one pose
  std::vector<std::size_t> led_to;
  for (const MotionEnds& motion : motions) {
    if (ends.empty() || !isSame(ends.back(), motion.from)) ends.push_back(motion.from);
    ends.push_back(motion.to);
    led_to.push_back(ends.size() - 1);
  }
  const double clearance = std::max(kMarginOfMotions * rules_.near_miss, kMotionTolerance);
  std::vector<std::optional<Obstruction>> obstacles;
  for (const MotionReport& motion : motion_check_.check(endsOf(ends), led_to, clearance)) {
    obstacles.push_back(std::nullopt);
    if (!motion.hasFinding()) continue;
    obstacles.back() = Obstruction{motion.at.part, motion.at.blade,
                                   motion.outcome == MotionReport::Outcome::too_deep, false};
  }
  return obstacles;
}

/// The poses, with what MotionCheck needs.
std::vector<PoseReport> Judge::endsOf(std::span<const Pose> ends) {
  std::vector<PoseReport> reports(ends.size());
  std::vector<std::size_t> parts, report_of;
  std::vector<Pose> places;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    reports[i].tool_in_blisk = ends[i];
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      if (!obstacles_.mayTouchAny(part)) continue;
      parts.push_back(part);
      report_of.push_back(i);
      places.push_back(ends[i]);
    }
  }
  const auto depths = depths_->measure(parts, places);
  for (std::size_t k = 0; k < depths.size(); ++k) {
    if (depths[k]) reports[report_of[k]].depths.push_back(*depths[k]);
  }
  measureClearances(ends, 0, reports);
  return reports;
}

}  // namespace octoblisk::demos
