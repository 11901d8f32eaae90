#include "plan/side_plan.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "plan/free_runs.h"
#include "plan/links.h"
#include "plan/pass_lines.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// The share of the side below which a setup is not worth its way from home and back.
constexpr double kLeastSetup = 2e-3;

/// The number of cells at which postures are compared. Each stands for 0.5 % of what is left.
constexpr std::size_t kSites = 200;

/// The centres of the cells in the frame of the blisk's mesh.
SurfaceGrid surfaceOf(const SideGrid& grid, const Pose& mesh_in_blisk) {
  const Pose blisk_in_mesh = mesh_in_blisk.inverse();
  SurfaceGrid surface{grid.rows(), grid.columns(), {}};
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const std::size_t row = cell / grid.columns(), column = cell % grid.columns();
    const auto at = [&](std::size_t r) { return grid.middleOf(r * grid.columns() + column).position; };
    const auto& [position, normal] = grid.middleOf(cell);
    const Vec3 up = at(std::min(row + 1, grid.rows() - 1)) - at(row > 0 ? row - 1 : 0);
    surface.points.push_back({blisk_in_mesh * position, blisk_in_mesh.rotation * normal,
                              blisk_in_mesh.rotation * (up - up.dot(normal) * normal).normalized()});
  }
  return surface;
}

class Planner {
 public:
  Planner(Judge& judge, const SideGrid& grid, const Pose& mesh_in_blisk, const WheelSeat& seat,
          const PlanOptions& options, const GroundBefore& before, const RunWatch& watch)
      : judge_(judge),
        grid_(grid),
        mesh_in_blisk_(mesh_in_blisk),
        seat_(seat),
        options_(options),
        poses_before_(before.poses),
        watch_(watch),
        belt_(*judge.parts()[judge.rules().grinding_part].tree),
        wheel_(wheelOf(belt_)),
        home_(judge),
        surface_(surfaceOf(grid, mesh_in_blisk)),
        postures_(posturesOf(wheel_.width)),
        uses_(postures_.size()) {
    for (std::size_t cell = 0; cell < grid.size(); ++cell) area_ += grid.areaOf(cell);
    plan_.points = before.points;
    plan_.points.resize(grid.size());
  }

  SidePlan run() {
    while (const std::optional<std::size_t> posture = bestPosture()) {
      addSetup(*posture);
      watch_.report("parts per thousand ground", static_cast<std::size_t>(1000.0 * (1.0 - shareLeft())));
    }
    return std::move(plan_);
  }

 private:
  struct Use {
    int times = 0;
    bool is_exhausted = false;
  };

  /// A posture at a site, and the answer of the judge.
  struct Trial {
    std::size_t site, posture;
    PoseState state = {};
  };

  bool isLeft(std::size_t cell) const { return !plan_.points[cell].isTouched(); }

  std::vector<std::size_t> cellsLeft() const {
    std::vector<std::size_t> cells;
    for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
      if (isLeft(cell)) cells.push_back(cell);
    }
    return cells;
  }

  double shareLeft() const {
    double area = 0.0;
    for (const std::size_t cell : cellsLeft()) area += grid_.areaOf(cell);
    return area / area_;
  }

  /// The posture that grinds most in a pass, over all sites; the first of several. If none is worth a setup,
  /// the obstacles of the sites are noted.
  std::optional<std::size_t> bestPosture() {
    const std::vector<Trial> trials = tryPostures();
    if (plan_.is_partial) return std::nullopt;
    std::vector<std::size_t> free(postures_.size(), 0);
    for (const Trial& trial : trials) {
      free[trial.posture] += !trial.state.obstacle && !uses_[trial.posture].is_exhausted;
    }
    const auto worth = [&](std::size_t p) {
      return static_cast<double>(free[p]) * postures_[p].partOfBelt();
    };
    std::size_t best = 0;
    for (std::size_t p = 1; p < postures_.size(); ++p) {
      if (worth(p) > worth(best)) best = p;
    }
    const std::size_t sites = std::min(kSites, cellsLeft().size());
    if (static_cast<double>(free[best]) * shareLeft() > kLeastSetup * static_cast<double>(sites)) return best;
    noteObstacles(trials, sites);
    return std::nullopt;
  }

  /// Judges all postures that grind a site, at sites spread evenly over the cells that are left.
  std::vector<Trial> tryPostures() {
    const std::vector<std::size_t> left = cellsLeft();
    const std::size_t sites = std::min(kSites, left.size());
    std::vector<std::vector<Pose>> seated(sites);
    const auto at = [&](std::size_t site) {
      return surface_.points[left[(2 * site + 1) * left.size() / (2 * sites)]];
    };
    parallelFor(sites, options_.threads,
                [&](std::size_t s, std::size_t) { seated[s] = seatedPostures(at(s)); });
    std::vector<Trial> trials;
    std::vector<Pose> poses;
    for (std::size_t site = 0; site < sites; ++site) {
      for (std::size_t p = 0; p < postures_.size(); ++p) {
        if (!grinds(seated[site][p], at(site).point)) continue;
        trials.push_back({site, p});
        poses.push_back(seated[site][p]);
      }
    }
    const std::vector<PoseState> states = statesOf(poses);
    for (std::size_t i = 0; i < trials.size(); ++i) trials[i].state = states[i];
    return trials;
  }

  /// The judge's answers; if the watch stops the plan, some are missing and the plan is partial.
  std::vector<PoseState> statesOf(std::span<const Pose> poses) {
    constexpr std::size_t kAtOnce = 2048;  // a fraction of a second
    std::vector<PoseState> states;
    for (std::size_t begin = 0; begin < poses.size() && !plan_.is_partial; begin += kAtOnce) {
      const auto next = judge_.statesOf(poses.subspan(begin, std::min(kAtOnce, poses.size() - begin)));
      states.insert(states.end(), next.begin(), next.end());
      plan_.is_partial = watch_.isStopped();
    }
    states.resize(poses.size());
    return states;
  }

  /// A tilt turns the wheel about its own axis and leaves it seated.
  std::vector<Pose> seatedPostures(const SurfacePoint& at) const {
    std::map<std::pair<double, double>, Vec3> seats;  // by lead and slide
    std::vector<Pose> poses;
    for (const ToolPosture& posture : postures_) {
      Pose pose = poseAt(at, posture, wheel_.radius);
      const auto [seat, is_new] = seats.try_emplace({posture.lead, posture.slide});
      if (is_new) seat->second = seat_.seated(pose, at.normal, options_.depth).translation;
      pose.translation = seat->second;
      poses.push_back(pose);
    }
    return poses;
  }

  /// Whether a point is in the belt on the contact wheel.
  bool grinds(const Pose& pose, const Vec3& point) const {
    const Vec3 in_tool = pose.inverse() * point;
    return in_tool.head<2>().norm() <= wheel_.radius && std::abs(in_tool.z()) <= 0.5 * wheel_.width;
  }

  /// Each site counts for the obstacle that most postures have there.
  void noteObstacles(const std::vector<Trial>& trials, std::size_t sites) {
    using Key = std::tuple<std::size_t, int, bool>;
    std::map<std::size_t, std::map<Key, std::size_t>> times;  // per site
    std::map<Key, UnreachedArea> areas;
    for (const Trial& trial : trials) {
      if (!trial.state.obstacle) continue;
      const auto& [part, blade, too_deep, is_inside] = *trial.state.obstacle;
      ++times[trial.site][{part, blade, too_deep}];
      areas.try_emplace({part, blade, too_deep}, *trial.state.obstacle);
    }
    for (const auto& [site, of_site] : times) {
      const auto most = std::ranges::max_element(of_site, {}, [](const auto& entry) { return entry.second; });
      areas[most->first].share += shareLeft() / static_cast<double>(sites);
    }
    for (const auto& [key, area] : areas) {
      if (area.share > 0.0) plan_.unreached.push_back(area);
    }
    std::ranges::stable_sort(plan_.unreached, std::greater{}, &UnreachedArea::share);
  }

  /// The cells that are left and that the belt grinds if it is placed on them.
  std::vector<bool> reachable(const Placer& placer) {
    const std::vector<std::size_t> cells = cellsLeft();
    std::vector<Pose> poses(cells.size());
    parallelFor(cells.size(), options_.threads,
                [&](std::size_t i, std::size_t) { poses[i] = placer.at(cells[i]); });
    const std::vector<PoseState> states = statesOf(poses);
    std::vector<bool> reachable(grid_.size(), false);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      reachable[cells[i]] = !states[i].obstacle && grinds(poses[i], surface_.points[cells[i]].point);
    }
    return reachable;
  }

  /// Adds the passes of a posture, unless they turn out not to be worth a setup.
  void addSetup(std::size_t index) {
    const ToolPosture& posture = postures_[index];
    Use& use = uses_[index];
    const Placer placer(surface_, seat_, posture, wheel_.radius, options_.depth);
    // The grid does not show every ridge of the surface. Where a pass grinds less than its width, the next
    // use of the posture makes passes half as far apart.
    const double apart = std::ldexp(posture.partOfBelt(), -use.times++);
    const std::vector<bool> wanted = reachable(placer);
    if (plan_.is_partial) return;
    const std::vector<PassLine> lines =
        passLines(surface_, wanted, posture.grindsTowardsTip(),
                  {.belt_width = wheel_.width, .scallop = options_.scallop, .part = apart});
    std::vector<Run> runs;
    for (FreeRun& run : freeRuns(judge_, placer, lines, options_.chord_error)) {
      runs.push_back({std::move(run.poses), surface_.points[run.cells.front()].normal,
                      surface_.points[run.cells.back()].normal});
    }
    const LinkedPath linked = linkRuns(judge_, home_, runs);
    const std::vector<GroundPoint> points = pointsOf(linked.poses);
    double ground = 0.0;
    for (const std::size_t cell : cellsLeft()) {
      if (points[cell].isTouched()) ground += grid_.areaOf(cell) / area_;
    }
    use.is_exhausted = ground < kLeastSetup;
    if (use.is_exhausted) return;
    if (!plan_.path.empty()) add(home_.between(plan_.path.back(), linked.poses.front()), {});
    const std::size_t first = poses_before_ + plan_.path.size();
    add(linked.poses, linked.grinds);
    for (std::size_t cell = 0; cell < points.size(); ++cell) {
      if (points[cell].depth <= plan_.points[cell].depth) continue;
      plan_.points[cell] = {points[cell].depth, first + points[cell].pose};
    }
    plan_.setups.push_back({posture, runs.size() - linked.lost.size(), linked.poses.size(), ground});
  }

  std::vector<GroundPoint> pointsOf(const std::vector<Pose>& path) const {
    std::vector<Pose> in_blisk;
    for (const Pose& pose : path) in_blisk.push_back(mesh_in_blisk_ * pose);
    return groundPoints(grid_, belt_, in_blisk, options_.threads);
  }

  /// Links if `grinds` is empty.
  void add(const std::vector<Pose>& poses, const std::vector<bool>& grinds) {
    plan_.path.insert(plan_.path.end(), poses.begin(), poses.end());
    plan_.grinds.insert(plan_.grinds.end(), grinds.begin(), grinds.end());
    plan_.grinds.resize(plan_.path.size(), false);
  }

  Judge& judge_;
  const SideGrid& grid_;
  const Pose& mesh_in_blisk_;
  const WheelSeat& seat_;
  const PlanOptions& options_;
  const std::size_t poses_before_;
  const RunWatch& watch_;
  const ClusteredOctree& belt_;
  const WheelSize wheel_;
  const Home home_;
  const SurfaceGrid surface_;
  const std::vector<ToolPosture> postures_;
  std::vector<Use> uses_;  // per posture
  double area_ = 0.0;
  SidePlan plan_;
};

}  // namespace

WheelSize wheelOf(const ClusteredOctree& belt) {
  const Aabb box = belt.mesh().bounds();
  return {-box.min.x(), box.max.z() - box.min.z()};
}

SidePlan planSide(Judge& judge, const SideGrid& grid, const Pose& mesh_in_blisk, const WheelSeat& seat,
                  const PlanOptions& options, const GroundBefore& before, const RunWatch& watch) {
  return Planner(judge, grid, mesh_in_blisk, seat, options, before, watch).run();
}

}  // namespace octoblisk::demos
