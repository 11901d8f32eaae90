#include "grinding/grinding_run.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "grinding/blade_side.h"
#include "octoblisk/batch.h"
#include "octoblisk/collide.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// Poses that are finished before the next are begun: a multiple of kPosesAtOnce, so that the answers do not
/// depend on the number of threads.
std::size_t posesAStretch(int threads) {
  constexpr std::size_t kGroupsAThread = 2;
  return kGroupsAThread * kPosesAtOnce * static_cast<std::size_t>(threadCount(threads));
}

/// The loads of the grinding part, pose by pose.
class Spindles {
 public:
  explicit Spindles(const GrindingJob& job) : job_(job) {
    if (!job.spindle || job.rules.grinding_part >= job.parts.size()) return;
    const ToolPart& belt = job.parts[job.rules.grinding_part];
    const auto blisk = onSpindle(job.blisk, job.mesh_in_blisk);
    for (int thread = 0; thread < threadCount(job.threads); ++thread) {
      cells_.push_back(std::make_unique<SpindleCell>(blisk, job.mesh_in_blisk, belt,
                                                     belt.belt_speed.value_or(0.0), *job.spindle));
    }
  }

  /// Adds those of the poses that have none yet.
  void addLoads(std::span<const PoseReport> poses, std::vector<std::optional<SpindleLoad>>& loads) {
    if (cells_.empty()) return;
    const std::size_t begin = loads.size();
    loads.resize(poses.size());
    parallelFor(poses.size() - begin, job_.threads, [&](std::size_t i, std::size_t worker) {
      const PoseReport& pose = poses[begin + i];
      const auto deepest = std::ranges::find(pose.depths, job_.rules.grinding_part, &PartDepth::part);
      if (deepest == pose.depths.end() || deepest->is_inside) return;
      loads[begin + i] = cells_[worker]->loadAt(pose.tool_in_blisk, deepest->depth);
    });
  }

 private:
  const GrindingJob& job_;
  std::vector<std::unique_ptr<SpindleCell>> cells_;  // one per thread
};

}  // namespace

std::string GrindingRun::sideOf(const Touch& touch) const {
  if (names().isFixture(touch.blade)) return {};
  return demos::sideOf(job.blisk->mesh(), job.mesh_in_blisk, touch.contact.triangle_a, touch.blade);
}

std::string GrindingRun::faceOf(const Touch& touch) const {
  const std::string side = sideOf(touch);
  if (side.empty() || !convex_side) return side;
  return (side == "forward") == (*convex_side == BladeSide::forward) ? "convex" : "concave";
}

std::size_t GrindingRun::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::ranges::count(poses, verdict, &PoseReport::verdict));
}

std::size_t GrindingRun::count(MotionReport::Outcome outcome) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      poses, [&](const PoseReport& pose) { return pose.motion && pose.motion->outcome == outcome; }));
}

std::size_t GrindingRun::motionCount() const {
  return job.continuous && !poses.empty() ? poses.size() - 1 : 0;
}

std::size_t GrindingRun::depthsProved() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      poses, [](const PoseReport& pose) { return pose.motion && pose.motion->depth_proved; }));
}

double GrindingRun::depthBound() const {
  double bound = 0.0;
  for (const PoseReport& pose : poses) {
    if (pose.motion) bound = std::max(bound, pose.motion->depth_bound);
  }
  return bound;
}

bool GrindingRun::interferes() const {
  using Outcome = MotionReport::Outcome;
  return count(Verdict::interference) + count(Verdict::unknown) + count(Outcome::hit) +
             count(Outcome::too_deep) + count(Outcome::not_proved) >
         0;
}

GrindingRun runGrinding(GrindingJob job, const RunWatch& watch) {
  GrindingRun run;
  run.job = std::move(job);
  const GrindingJob& asked = run.job;
  VerdictRules& rules = run.job.rules;
  rules.blade_count = asked.blades.count;
  if (asked.find_ground_blade) {
    const ClusteredOctree& belt = *asked.parts[rules.grinding_part].tree;
    const std::optional<int> blade = bladeTouchedMost(*asked.blisk, belt, asked.blades.blade_of_triangle,
                                                      asked.path, asked.threads, watch);
    if (!blade) return run;
    rules.ground_blade = *blade;
  }
  Judge judge(asked.blisk, asked.parts, asked.blades.blade_of_triangle, rules, asked.threads, asked.fixtures,
              asked.depths);
  Spindles spindles(asked);
  for (std::size_t part = 0; part < asked.parts.size(); ++part) {
    run.depth_kinds.push_back(judge.depthKind(part));
  }
  const std::size_t stretch = posesAStretch(asked.threads);
  while (run.poses.size() < asked.path.size() && !watch.isStopped()) {
    const std::size_t end = std::min(asked.path.size(), run.poses.size() + stretch);
    judge.judgeNext(asked.path, end, asked.continuous, run.poses, run.per_pose);
    spindles.addLoads(run.poses, run.loads);
    watch.report("poses", end);
  }
  const double poses = std::max<double>(1.0, static_cast<double>(run.poses.size()));
  for (double* const seconds :
       {&run.per_pose.contacts, &run.per_pose.depths, &run.per_pose.clearances, &run.per_pose.motions}) {
    *seconds /= poses;
  }
  return run;
}

std::optional<int> bladeTouchedMost(const ClusteredOctree& blisk, const ClusteredOctree& belt,
                                    std::span<const int> blade_of_triangle, std::span<const Pose> path,
                                    int threads, const RunWatch& watch) {
  constexpr std::size_t kTouchesAtOnce = 256;
  std::vector<std::set<int>> touched(path.size());
  for (std::size_t begin = 0; begin < path.size(); begin += kTouchesAtOnce) {
    if (watch.isStopped()) return std::nullopt;
    const std::size_t end = std::min(path.size(), begin + kTouchesAtOnce);
    parallelFor(end - begin, threads, [&](std::size_t i, std::size_t) {
      std::vector<TrianglePair> pairs;
      touchingPairs(blisk, belt, path[begin + i], pairs);
      for (const TrianglePair& pair : pairs) touched[begin + i].insert(blade_of_triangle[pair.a]);
    });
    watch.report("which blade is ground", end);
  }
  std::map<int, int> poses_of_blade;
  for (const std::set<int>& blades : touched) {
    for (const int blade : blades) {
      if (blade != 0) ++poses_of_blade[blade];
    }
  }
  const auto most =
      std::ranges::max_element(poses_of_blade, {}, [](const auto& entry) { return entry.second; });
  return most == poses_of_blade.end() ? 0 : most->first;
}

}  // namespace octoblisk::demos
