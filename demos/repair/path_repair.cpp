#include "repair/path_repair.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "models/require.h"
#include "models/triangle_tree.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/path_query.h"
#include "repair/layered_search.h"

namespace octoblisk::demos {
namespace {

constexpr std::size_t kMaxAtOnce = 256;  // changes per pose
constexpr std::size_t kMaxTriesPerMotion = 32;
constexpr std::size_t kTriesBeforeRetracting = 2;
constexpr std::size_t kTriesToKeepContact = 16;  // more tries, to keep a contact
constexpr std::size_t kMaxDoublings = 4;

/// The search for one path, with the known states of its nodes and steps.
class Repairer {
 public:
  /// `contact_poses`: the poses that should keep their contact.
  Repairer(Judge& judge, std::span<const Pose> path, std::span<const Vec3> off_surface,
           const ChangeLimits& limits, std::vector<bool> contact_poses)
      : judge_(judge),
        path_(path),
        off_surface_(off_surface),
        keeps_contact_(std::move(contact_poses)),
        grid_(limits),
        search_(grid_, path.size()),
        known_(path.size() * grid_.size(), 0),
        by_cost_(grid_.size()),
        next_(path.size(), 0),
        at_once_(path.size(), 1),
        tries_(path.size(), 0),
        least_retract_(path.size(), 0) {
    std::iota(by_cost_.begin(), by_cost_.end(), 0u);
    std::ranges::stable_sort(by_cost_, {},
                             [&](std::uint32_t node) { return grid_.cost(grid_.change(node)); });
    for (std::size_t p = 0; p < path.size(); ++p) {
      for (std::uint32_t node = 0; keeps_contact_[p] && node < grid_.size(); ++node) {
        if (grid_.change(node).retract > kLift) search_.markLosing(p, node);
      }
    }
  }

  /// The route found; if stopped, the best so far.
  std::vector<std::uint32_t> run(const RunWatch& watch) {
    for (;;) {
      std::vector<std::uint32_t> route = search_.cheapest();
      is_stopped_ = watch.isStopped();
      if (is_stopped_) return route;
      if (judgePoses(route)) {
        watch.report(kTask, settled(route));
        continue;
      }
      if (judgeMotions(route)) continue;
      watch.report(kTask, path_.size());
      return route;
    }
  }
  bool isStopped() const { return is_stopped_; }

  /// An unchanged pose stays the same to the last bit.
  Pose pose(std::size_t index, std::uint32_t node) const {
    const Change change = grid_.change(node);
    return change.isNone() ? path_[index] : changedPose(path_[index], off_surface_[index], change);
  }
  bool isFreeMotion(std::size_t pose, const std::vector<std::uint32_t>& route) const {
    return free_motions_.contains({pose, route[pose - 1], route[pose]});
  }
  const ChangeGrid& grid() const { return grid_; }
  std::size_t asked(std::size_t pose) const {
    const auto begin = known_.begin() + static_cast<std::ptrdiff_t>(pose * grid_.size());
    const auto end = begin + static_cast<std::ptrdiff_t>(grid_.size());
    return grid_.size() - static_cast<std::size_t>(std::count(begin, end, kUnknown));
  }

 private:
  static constexpr char kUnknown = 0, kFree = 1, kLosing = 2, kBlocked = 3;
  static constexpr const char* kTask = "free poses";

  char& known(std::size_t pose, std::uint32_t node) { return known_[pose * grid_.size() + node]; }
  bool isFree(std::size_t pose, std::uint32_t node) {
    return known(pose, node) == kFree || known(pose, node) == kLosing;
  }

  std::size_t settled(const std::vector<std::uint32_t>& route) {
    std::size_t count = 0;
    for (std::size_t p = 0; p < route.size(); ++p) count += isFree(p, route[p]);
    return count;
  }

  /// Judges the unknown nodes of the route. At poses whose nodes turned out blocked or losing contact before,
  /// it also judges the next cheapest nodes. Returns true if a node of the route is newly found to be blocked
  /// or losing contact.
  bool judgePoses(const std::vector<std::uint32_t>& route) {
    std::vector<std::pair<std::size_t, std::uint32_t>> asked;
    std::vector<Pose> poses;
    const auto ask = [&](std::size_t p, std::uint32_t node) {
      asked.emplace_back(p, node);
      poses.push_back(pose(p, node));
    };
    for (std::size_t p = 0; p < route.size(); ++p) {
      if (known(p, route[p]) != kUnknown) continue;
      ask(p, route[p]);
      for (std::size_t more = 1; more < at_once_[p] && next_[p] < by_cost_.size(); ++next_[p]) {
        const std::uint32_t node = by_cost_[next_[p]];
        if (node == route[p] || known(p, node) != kUnknown) continue;
        ask(p, node);
        ++more;
      }
    }
    const std::vector<PoseState> states = judge_.statesOf(poses);
    bool any_worse = false;
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const auto [p, node] = asked[k];
      if (states[k].obstacle) {
        known(p, node) = kBlocked;
        search_.blockNode(p, node);
      } else if (keeps_contact_[p] && !states[k].grinds) {
        known(p, node) = kLosing;
        search_.markLosing(p, node);
      } else {
        known(p, node) = kFree;
        continue;
      }
      if (node != route[p]) continue;
      any_worse = true;
      at_once_[p] = std::min(2 * at_once_[p], kMaxAtOnce);
    }
    return any_worse;
  }

  /// The same for the motions between free poses.
  bool judgeMotions(const std::vector<std::uint32_t>& route) {
    std::vector<std::size_t> asked;
    std::vector<MotionEnds> motions;
    for (std::size_t p = 1; p < route.size(); ++p) {
      if (hasGivenUp(p)) continue;
      if (!isFree(p - 1, route[p - 1]) || !isFree(p, route[p])) continue;
      if (isFreeMotion(p, route)) continue;
      asked.push_back(p);
      motions.push_back({pose(p - 1, route[p - 1]), pose(p, route[p])});
    }
    const auto found = judge_.obstaclesOf(motions);
    bool any_blocked = false;
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const std::size_t p = asked[k];
      if (!found[k]) {
        free_motions_.insert({p, route[p - 1], route[p]});
        continue;
      }
      any_blocked = true;
      search_.blockStep(p, route[p - 1], route[p]);
      ++tries_[p];
      const std::size_t patience = patienceFor(p);
      if (hasGivenUp(p)) {
        giveUpOnMotion(p);
      } else if (tries_[p] > patience && (tries_[p] - patience) % kTriesBeforeRetracting == 0) {
        retractMotion(p, route, (tries_[p] - patience) / kTriesBeforeRetracting);
      }
    }
    return any_blocked;
  }

  /// Retracts both ends of a motion that is blocked again and again, each time by twice as many steps.
  void retractMotion(std::size_t pose, const std::vector<std::uint32_t>& route, std::size_t times) {
    const std::size_t retracts = grid_.retracts().size();
    const std::size_t more = std::size_t{1} << std::min(times - 1, kMaxDoublings);
    for (const std::size_t end : {pose - 1, pose}) {
      least_retract_[end] =
          std::min(retracts - 1, std::max(least_retract_[end], route[end] % retracts + more));
      search_.avoidBelow(end, least_retract_[end]);
    }
  }

  /// The number of tries of a motion before its ends must retract.
  std::size_t patienceFor(std::size_t pose) const {
    return keeps_contact_[pose - 1] || keeps_contact_[pose] ? kTriesToKeepContact : 0;
  }
  bool hasGivenUp(std::size_t pose) const { return tries_[pose] > kMaxTriesPerMotion + patienceFor(pose); }

  void giveUpOnMotion(std::size_t pose) {
    search_.unblockSteps(pose);
    for (const std::size_t end : {pose - 1, pose}) {
      least_retract_[end] = 0;
      search_.avoidBelow(end, 0);
    }
  }

  Judge& judge_;
  std::span<const Pose> path_;
  std::span<const Vec3> off_surface_;
  std::vector<bool> keeps_contact_;
  ChangeGrid grid_;
  LayeredSearch search_;
  std::vector<char> known_;                 // per pose and node
  std::vector<std::uint32_t> by_cost_;      // nodes, in order of cost
  std::vector<std::size_t> next_;           // per pose: the first in by_cost_ that may be unknown
  std::vector<std::size_t> at_once_;        // per pose: number of nodes to judge together
  std::vector<std::size_t> tries_;          // per pose: number of blocked motions to it
  std::vector<std::size_t> least_retract_;  // per pose: indices of the grid's retractions
  std::set<std::tuple<std::size_t, std::uint32_t, std::uint32_t>> free_motions_;  // pose, from, to
  bool is_stopped_ = false;
};

/// Only the ground blade's triangles; null if no blade is ground.
std::shared_ptr<const ClusteredOctree> groundBladeOf(const Judge& judge) {
  const TriangleMesh& mesh = judge.blisk().mesh();
  std::vector<TriangleMesh::Indices> ground;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const int blade = judge.bodyOfTriangle()[t];
    if (blade != 0 && blade == judge.rules().ground_blade) ground.push_back(mesh.triangles()[t]);
  }
  return ground.empty() ? nullptr : treeOfTriangles(mesh, std::move(ground));
}

/// The poses at which the grinding part touches the ground blade.
std::vector<bool> workingPoses(const Judge& judge, std::span<const Pose> path) {
  std::vector<bool> works(path.size(), false);
  const auto blade = groundBladeOf(judge);
  if (!blade || judge.rules().grinding_part == kNoPart) return works;
  PathQuery query(*blade, *judge.parts()[judge.rules().grinding_part].tree);
  for (std::size_t p = 0; p < path.size(); ++p) works[p] = query.collide(path[p]).has_value();
  return works;
}

}  // namespace

std::size_t PathRepair::interferedBefore() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(poses, [](const PoseRepair& pose) { return pose.before.obstacle.has_value(); }));
}

std::size_t PathRepair::posesLeft() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(poses, [](const PoseRepair& pose) { return pose.after.obstacle.has_value(); }));
}

std::size_t PathRepair::motionsLeft() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(poses, [](const PoseRepair& pose) { return pose.motion.has_value(); }));
}

std::size_t PathRepair::changed() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(poses, [](const PoseRepair& pose) { return !pose.change.isNone(); }));
}

std::size_t PathRepair::working() const {
  return static_cast<std::size_t>(std::ranges::count_if(poses, &PoseRepair::works));
}

bool PathRepair::hasLostContact(std::size_t pose) const {
  return poses[pose].works && !poses[pose].after.obstacle && !poses[pose].after.grinds;
}

std::size_t PathRepair::contactsLost() const {
  std::size_t count = 0;
  for (std::size_t p = 0; p < poses.size(); ++p) count += hasLostContact(p);
  return count;
}

PathRepair repairPath(Judge& judge, std::span<const Pose> path, std::span<const Vec3> off_surface,
                      const ChangeLimits& limits, bool keep_contact, const RunWatch& watch) {
  require(!path.empty(), "a path without poses cannot be repaired");
  require(off_surface.size() == path.size(), "each pose needs a direction off the surface");
  const std::vector<bool> works = workingPoses(judge, path);
  Repairer repairer(judge, path, off_surface, limits,
                    keep_contact ? works : std::vector<bool>(path.size(), false));
  const std::vector<std::uint32_t> route = repairer.run(watch);

  PathRepair repair;
  repair.is_partial = repairer.isStopped();
  for (std::size_t p = 0; p < path.size(); ++p) {
    repair.path.push_back(repairer.pose(p, route[p]));
    repair.poses.push_back({});
    repair.poses.back().change = repairer.grid().change(route[p]);
    repair.poses.back().asked = repairer.asked(p);
    repair.poses.back().works = works[p];
  }
  const std::vector<PoseState> before = judge.statesOf(path), after = judge.statesOf(repair.path);
  std::vector<MotionEnds> motions;
  std::vector<std::size_t> motion_to;
  for (std::size_t p = 0; p < path.size(); ++p) {
    repair.poses[p].before = before[p];
    repair.poses[p].after = after[p];
    if (p == 0 || repair.is_partial || after[p - 1].obstacle || after[p].obstacle) continue;
    if (repairer.isFreeMotion(p, route)) continue;
    motions.push_back({repair.path[p - 1], repair.path[p]});
    motion_to.push_back(p);
  }
  const auto blocking = judge.obstaclesOf(motions);
  for (std::size_t k = 0; k < motions.size(); ++k) repair.poses[motion_to[k]].motion = blocking[k];
  return repair;
}

std::vector<Vec3> directionsOffSurface(const Judge& judge, std::span<const Pose> path) {
  const auto blade = groundBladeOf(judge);
  std::vector<Vec3> directions;
  for (const Pose& pose : path) {
    Vec3 direction = Vec3::Zero();
    if (blade) direction = pose.translation - closestPoint(*blade, pose.translation)->point;
    directions.push_back(direction.isZero() ? Vec3(pose.rotation.col(0)) : direction.normalized());
  }
  return directions;
}

}  // namespace octoblisk::demos
