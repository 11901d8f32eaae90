#include "plan/links.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "octoblisk/body_bounds.h"

namespace octoblisk::demos {
namespace {

constexpr double kHomeStep = std::numbers::pi / 6.0;  // around the blisk

/// Lengths by which the tool leaves the surface along the normal, in a narrow channel and in a wide one, mm.
constexpr double kLifts[] = {0.2, 1.0, 4.0};
/// Lengths by which it then retracts along the arm to move across, mm.
constexpr double kRetracts[] = {0.0, 4.0, 16.0, 64.0};

/// How far the tool leaves the surface: along the normal, then along the arm.
struct Retreat {
  double lift, retract;
};

std::vector<Retreat> retreats() {
  std::vector<Retreat> all;
  for (const double retract : kRetracts) {
    for (const double lift : kLifts) all.push_back({lift, retract});
  }
  return all;
}

Pose lifted(const Pose& pose, const Vec3& off, const Retreat& retreat) {
  return {pose.rotation, pose.translation + retreat.lift * off + retreat.retract * pose.rotation.col(0)};
}

/// Whether the tool is free at the places between the first and the last pose, and on all motions.
std::vector<bool> areFree(Judge& judge, const std::vector<std::vector<Pose>>& ways) {
  std::vector<Pose> places;
  std::vector<std::size_t> way_of_place, way_of_motion;
  std::vector<bool> free(ways.size(), true);
  for (std::size_t way = 0; way < ways.size(); ++way) {
    for (const Pose& pose : ways[way]) {
      places.push_back(pose);
      way_of_place.push_back(way);
    }
  }
  const std::vector<PoseState> states = judge.statesOf(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (states[i].obstacle) free[way_of_place[i]] = false;
  }
  std::vector<MotionEnds> motions;
  for (std::size_t way = 0; way < ways.size(); ++way) {
    for (std::size_t k = 1; free[way] && k < ways[way].size(); ++k) {
      motions.push_back({ways[way][k - 1], ways[way][k]});
      way_of_motion.push_back(way);
    }
  }
  const auto obstacles = judge.obstaclesOf(motions);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (obstacles[i]) free[way_of_motion[i]] = false;
  }
  return free;
}

/// The first free one of the ways home from a pose, without the pose itself.
std::optional<std::vector<Pose>> wayHome(Judge& judge, const Home& home, const Pose& from, const Vec3& off) {
  for (const double lift : kLifts) {
    const Pose off_surface = lifted(from, off, {lift, 0.0});
    const std::vector<Pose> way = {from, off_surface, home.of(off_surface)};
    if (areFree(judge, {way})[0]) return std::vector<Pose>{way[1], way[2]};
  }
  return std::nullopt;
}

}  // namespace

Home::Home(const Judge& judge) {
  Aabb around = judge.blisk().mesh().bounds();
  double tool = 0.0;
  for (std::size_t part = 0; part < judge.parts().size(); ++part) {
    tool = std::max(tool, BodyBounds(*judge.parts()[part].tree).distanceFromPoint(Vec3::Zero()));
    if (const Obstacle* obstacle = judge.obstacles().of(part)) {
      const Aabb box = obstacle->tree().mesh().bounds();
      around.min = around.min.cwiseMin(box.min);
      around.max = around.max.cwiseMax(box.max);
    }
  }
  center_ = 0.5 * (around.min + around.max);
  const double blisk = 0.5 * (around.max - around.min).norm();
  distance_ = (blisk + tool) / std::cos(0.5 * kHomeStep);  // the motions between two homes are chords
}

Pose Home::of(const Pose& pose) const {
  const Vec3 from_center = pose.translation - center_;
  const double along = from_center.dot(pose.rotation.col(0));
  const double across = from_center.squaredNorm() - along * along;
  const double length = std::sqrt(std::max(0.0, distance_ * distance_ - across)) - along;
  return {pose.rotation, pose.translation + std::max(0.0, length) * pose.rotation.col(0)};
}

std::vector<Pose> Home::between(const Pose& from, const Pose& to) const {
  const Vec3 a = from.translation - center_, b = to.translation - center_;
  const Eigen::AngleAxisd around(Eigen::Quaterniond::FromTwoVectors(a, b));
  const Eigen::AngleAxisd turn(Mat3(to.rotation * from.rotation.transpose()));
  const int steps = static_cast<int>(std::ceil(around.angle() / kHomeStep));
  std::vector<Pose> homes;
  for (int k = 1; k < steps; ++k) {
    const double part = static_cast<double>(k) / steps;
    const Vec3 place = Eigen::AngleAxisd(part * around.angle(), around.axis()) * a;
    homes.push_back({Mat3(Eigen::AngleAxisd(part * turn.angle(), turn.axis()) * from.rotation),
                     center_ + place.normalized() * std::lerp(a.norm(), b.norm(), part)});
  }
  return homes;
}

LinkedPath linkRuns(Judge& judge, const Home& home, const std::vector<Run>& runs) {
  std::vector<std::vector<Pose>> links(runs.size());  // from each run to the next; empty: through home
  for (const Retreat& retreat : retreats()) {
    std::vector<std::size_t> open;
    std::vector<std::vector<Pose>> ways;
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
      if (!links[i].empty()) continue;
      const Pose &last = runs[i].poses.back(), &first = runs[i + 1].poses.front();
      open.push_back(i);
      std::vector<Pose>& way = ways.emplace_back();
      way.push_back(last);
      way.push_back(lifted(last, runs[i].off_last, {retreat.lift, 0.0}));
      if (retreat.retract > 0.0) {
        way.push_back(lifted(last, runs[i].off_last, retreat));
        way.push_back(lifted(first, runs[i + 1].off_first, retreat));
      }
      way.push_back(lifted(first, runs[i + 1].off_first, {retreat.lift, 0.0}));
      way.push_back(first);
    }
    const std::vector<bool> free = areFree(judge, ways);
    for (std::size_t k = 0; k < open.size(); ++k) {
      if (free[k]) links[open[k]].assign(ways[k].begin() + 1, ways[k].end() - 1);
    }
  }

  LinkedPath path;
  const auto add = [&](const Pose& pose, bool grinds) {
    path.poses.push_back(pose);
    path.grinds.push_back(grinds);
  };
  const auto addHome = [&](const std::vector<Pose>& way) {  // outward
    for (const Pose& pose : way) add(pose, false);
  };
  for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
    end = begin + 1;
    while (end < runs.size() && !links[end - 1].empty()) ++end;
    std::optional<std::vector<Pose>> in, out;
    std::size_t first = begin, last = end;
    for (; first < end && !in; ++first)
      in = wayHome(judge, home, runs[first].poses.front(), runs[first].off_first);
    for (; last > first && !out; --last)
      out = wayHome(judge, home, runs[last - 1].poses.back(), runs[last - 1].off_last);
    first -= in.has_value();
    last += out.has_value();
    for (std::size_t i = begin; i < end; ++i) {
      if (i < first || i >= last || !in || !out) path.lost.push_back(i);
    }
    if (!in || !out) continue;
    std::ranges::reverse(*in);
    if (!path.poses.empty()) addHome(home.between(path.poses.back(), in->front()));
    addHome(*in);
    for (std::size_t i = first; i < last; ++i) {
      for (const Pose& pose : runs[i].poses) add(pose, true);
      if (i + 1 < last) addHome(links[i]);
    }
    addHome(*out);
  }
  return path;
}

}  // namespace octoblisk::demos
