#include "grinding/grinding_run.h"

#include <algorithm>
#include <chrono>

#include "base/parallel.h"
#include "grinding/blade_side.h"
#include "grinding/ground_blade.h"
#include "grinding/judge.h"
#include "grinding/reduce_contacts.h"
#include "octoblisk/batch.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// Poses that are finished before the next are begun: a multiple of kPosesAtOnce, so that the answers do not
/// depend on the number of threads.
std::size_t posesAStretch(int threads) {
  constexpr std::size_t kGroupsAThread = 2;
  return kGroupsAThread * kPosesAtOnce * static_cast<std::size_t>(threadCount(threads));
}

/// Adds its lifetime to a sum, in seconds.
class TimeAdded {
 public:
  explicit TimeAdded(double& sum) : sum_(sum) {}
  ~TimeAdded() { sum_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  TimeAdded(const TimeAdded&) = delete;
  TimeAdded& operator=(const TimeAdded&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

/// For each part, the greatest distance at which any blade is a near miss.
std::vector<double> reachesOf(const GrindingJob& job, const VerdictRules& rules) {
  std::vector<double> reaches(job.parts.size(), 0.0);
  for (std::size_t part = 0; part < reaches.size(); ++part) {
    for (int body = 0; body <= job.blades.count + static_cast<int>(job.fixtures.size()); ++body) {
      if (!rules.allows(part, body)) reaches[part] = std::max(reaches[part], rules.margin(part, body));
    }
  }
  return reaches;
}

/// Works through the path, several poses at a time.
class Grinding {
 public:
  Grinding(const GrindingJob& job, GrindingRun& run)
      : job_(job),
        run_(run),
        judge_(job.blisk, job.parts, job.blades.blade_of_triangle, run.rules, job.threads, job.fixtures,
               job.depths) {
    const std::vector<double> reaches = reachesOf(job, run.rules);
    for (int thread = 0; thread < threadCount(job.threads); ++thread) {
      cells_.push_back(std::make_unique<GrindingCell>(job.blisk, job.parts, reaches, judge_.obstacles()));
    }
    if (job.spindle && job.rules.grinding_part < job.parts.size()) {
      const ToolPart& belt = job.parts[job.rules.grinding_part];
      const auto blisk = onSpindle(job.blisk, job.mesh_in_blisk);
      for (int thread = 0; thread < threadCount(job.threads); ++thread) {
        spindles_.push_back(std::make_unique<SpindleCell>(blisk, job.mesh_in_blisk, belt,
                                                          belt.belt_speed.value_or(0.0), *job.spindle));
      }
    }
    for (std::size_t part = 0; part < job.parts.size(); ++part) {
      run.depth_kinds.push_back(judge_.depthKind(part));
    }
  }

  void doPoses(std::size_t begin, std::size_t end) {
    run_.poses.resize(end);
    const std::span<PoseReport> poses = std::span(run_.poses).subspan(begin);
    findContacts(begin, poses);
    {
      const TimeAdded watch(run_.depth_seconds_per_pose);
      judge_.measureDepths(poses);
    }
    judge_.setVerdicts(poses);
    if (!spindles_.empty()) findLoads(begin, poses);
    {
      const TimeAdded watch(run_.clearance_seconds_per_pose);
      judge_.measureClearances(poses, begin > 0 ? &job_.path[begin - 1] : nullptr,
                               end < job_.path.size() ? &job_.path[end] : nullptr);
    }
    if (job_.continuous) {
      const TimeAdded watch(run_.motion_seconds_per_pose);
      judge_.checkMotions(std::span(run_.poses).subspan(begin > 0 ? begin - 1 : 0));
    }
  }

 private:
  void findContacts(std::size_t begin, std::span<PoseReport> poses) {
    const TimeAdded watch(run_.contact_seconds_per_pose);
    parallelFor(poses.size(), job_.threads, [&](std::size_t i, std::size_t worker) {
      PoseReport& report = poses[i];
      report.tool_in_blisk = job_.path[begin + i];
      report.contacts =
          reduceContacts(cells_[worker]->contactsAt(report.tool_in_blisk), judge_.bodyOfTriangle());
      for (const PartContact& found : report.contacts) {
        report.blades.push_back(judge_.bodyOfTriangle()[found.contact.triangle_a]);
      }
    });
  }

  void findLoads(std::size_t begin, std::span<const PoseReport> poses) {
    run_.loads.resize(begin + poses.size());
    const std::size_t belt = run_.rules.grinding_part;
    parallelFor(poses.size(), job_.threads, [&](std::size_t i, std::size_t worker) {
      const auto deepest = std::ranges::find(poses[i].depths, belt, &PartDepth::part);
      if (deepest == poses[i].depths.end() || deepest->is_inside) return;
      run_.loads[begin + i] = spindles_[worker]->loadAt(poses[i].tool_in_blisk, deepest->depth);
    });
  }

  const GrindingJob& job_;
  GrindingRun& run_;
  Judge judge_;
  std::vector<std::unique_ptr<GrindingCell>> cells_;    // one per thread
  std::vector<std::unique_ptr<SpindleCell>> spindles_;  // one per thread, if forces are asked for
};

}  // namespace

std::string GrindingRun::sideOf(std::uint32_t triangle, int body) const {
  if (names().isFixture(body)) return {};
  return demos::sideOf(blisk->mesh(), mesh_in_blisk, triangle, body);
}

std::string GrindingRun::faceOf(std::uint32_t triangle, int body) const {
  const std::string side = sideOf(triangle, body);
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

std::size_t GrindingRun::motionCount() const { return continuous && !poses.empty() ? poses.size() - 1 : 0; }

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

GrindingRun runGrinding(const GrindingJob& job, const RunWatch& watch) {
  GrindingRun run;
  run.blisk = job.blisk;
  run.parts = job.parts;
  run.blade_count = job.blades.count;
  run.blade_of_triangle = job.blades.blade_of_triangle;
  run.mesh_in_blisk = job.mesh_in_blisk;
  run.fixtures = job.fixtures;
  run.rules = job.rules;
  run.rules.blade_count = job.blades.count;
  run.continuous = job.continuous;
  run.spindle = job.spindle;
  run.path_poses = job.path.size();
  if (job.find_ground_blade) {
    const ClusteredOctree& belt = *job.parts[job.rules.grinding_part].tree;
    const std::optional<int> blade =
        bladeTouchedMost(*job.blisk, belt, job.blades.blade_of_triangle, job.path, job.threads, watch);
    if (!blade) return run;
    run.rules.ground_blade = *blade;
  }
  Grinding grinding(job, run);
  const std::size_t stretch = posesAStretch(job.threads);
  for (std::size_t begin = 0; begin < job.path.size() && !watch.isStopped(); begin += stretch) {
    const std::size_t end = std::min(job.path.size(), begin + stretch);
    grinding.doPoses(begin, end);
    watch.report("poses", end);
  }
  const double poses = std::max<double>(1.0, static_cast<double>(run.poses.size()));
  for (double* const seconds : {&run.contact_seconds_per_pose, &run.depth_seconds_per_pose,
                                &run.clearance_seconds_per_pose, &run.motion_seconds_per_pose}) {
    *seconds /= poses;
  }
  return run;
}

}  // namespace octoblisk::demos
