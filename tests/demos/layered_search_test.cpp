// The cheapest route through layers, compared with a search over every pair of nodes.
#include "repair/layered_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace octoblisk::demos {
namespace {

using Step = std::tuple<std::size_t, std::uint32_t, std::uint32_t>;

/// Orders by blocked nodes and steps first, then by cost.
struct Price {
  int blocked = 0;
  double cost = 0.0;
  auto operator<=>(const Price&) const = default;
};

struct Scene {
  ChangeGrid grid;
  std::size_t poses;
  std::set<std::pair<std::size_t, std::uint32_t>> blocked;
  std::set<Step> blocked_steps;

  bool within(std::uint32_t from, std::uint32_t to) const {
    const Change a = grid.change(from), b = grid.change(to);
    const ChangeLimits& limits = grid.limits();
    return std::abs(a.tilt - b.tilt) <= limits.tilt_per_pose + 1e-9 &&
           std::abs(a.slide - b.slide) <= limits.slide_per_pose + 1e-9 &&
           std::abs(a.retract - b.retract) <= limits.retract_per_pose + 1e-9;
  }
  Price ofNode(std::size_t pose, std::uint32_t node) const {
    return {blocked.contains({pose, node}) ? 1 : 0, grid.cost(grid.change(node))};
  }
  Price ofStep(std::size_t pose, std::uint32_t from, std::uint32_t to) const {
    const Change a = grid.change(from), b = grid.change(to);
    return {blocked_steps.contains({pose, from, to}) ? 1 : 0,
            grid.tiltStepCost(a.tilt - b.tilt) + grid.slideStepCost(a.slide - b.slide) +
                grid.retractStepCost(a.retract - b.retract)};
  }
  Price ofRoute(const std::vector<std::uint32_t>& route) const {
    Price sum;
    const auto add = [&](const Price& price) {
      sum.blocked += price.blocked;
      sum.cost += price.cost;
    };
    for (std::size_t p = 0; p < route.size(); ++p) {
      add(ofNode(p, route[p]));
      if (p > 0) add(ofStep(p, route[p - 1], route[p]));
    }
    return sum;
  }
  /// The value of the best route, found over all pairs of nodes.
  Price best() const {
    std::vector<Price> layer;
    for (std::uint32_t node = 0; node < grid.size(); ++node) layer.push_back(ofNode(0, node));
    for (std::size_t pose = 1; pose < poses; ++pose) {
      std::vector<Price> next(grid.size(), Price{1 << 20, 0.0});
      for (std::uint32_t from = 0; from < grid.size(); ++from) {
        for (std::uint32_t to = 0; to < grid.size(); ++to) {
          if (!within(from, to)) continue;
          const Price node = ofNode(pose, to), step = ofStep(pose, from, to);
          next[to] = std::min(next[to], Price{layer[from].blocked + node.blocked + step.blocked,
                                              layer[from].cost + node.cost + step.cost});
        }
      }
      layer = next;
    }
    return *std::ranges::min_element(layer);
  }
};

TEST(LayeredSearch, isTheBestOfAllPairsOfNodes) {
  std::mt19937 random(3);
  const auto chance = [&](double part) {
    return std::uniform_real_distribution<double>(0, 1)(random) < part;
  };
  std::size_t with_blocked = 0, scenes = 60;
  for (std::size_t s = 0; s < scenes; ++s) {
    const ChangeLimits limits{.tilt = 4,
                              .tilt_grid = 2,
                              .tilt_per_pose = 2,
                              .slide = 2,
                              .slide_grid = 1,
                              .slide_per_pose = s % 2 ? 1.0 : 2.0,
                              .retract = 1.0,
                              .retract_grid = 0.25,
                              .retract_per_pose = 0.5};
    Scene scene{ChangeGrid(limits), 6, {}, {}};
    LayeredSearch search(scene.grid, scene.poses);
    const double density = s % 3 == 0 ? 0.4 : 0.985;
    for (std::size_t p = 0; p < scene.poses; ++p) {
      for (std::uint32_t node = 0; node < scene.grid.size(); ++node) {
        if (!chance(density)) continue;
        scene.blocked.insert({p, node});
        search.blockNode(p, node);
      }
    }
    // The nodes on the first few routes are blocked as well.
    for (int k = 0; k < 5; ++k) {
      const auto route = search.cheapest();
      const std::size_t p = 1 + random() % (scene.poses - 1);
      scene.blocked_steps.insert({p, route[p - 1], route[p]});
      search.blockStep(p, route[p - 1], route[p]);
    }
    const auto route = search.cheapest();
    for (std::size_t p = 1; p < route.size(); ++p)
      ASSERT_TRUE(scene.within(route[p - 1], route[p])) << "too far";
    const Price found = scene.ofRoute(route), best = scene.best();
    EXPECT_EQ(found.blocked, best.blocked) << "scene " << s;
    EXPECT_NEAR(found.cost, best.cost, 1e-5) << "scene " << s;
    with_blocked += best.blocked > 0;
  }
  EXPECT_GT(with_blocked, scenes * 3 / 10) << "some scenes have no free route";
  EXPECT_LT(with_blocked, scenes * 7 / 10);
}

TEST(LayeredSearch, afterEachChangeFindsTheRouteOfANewSearch) {
  const ChangeGrid grid({.tilt = 2, .slide = 2, .retract = 4.0, .retract_grid = 0.5});
  constexpr std::size_t kPoses = 50;
  LayeredSearch search(grid, kPoses);
  std::vector<std::function<void(LayeredSearch&)>> changes;
  std::mt19937 random(7);
  for (int k = 0; k < 60; ++k) {
    const std::vector<std::uint32_t> route = search.cheapest();
    const std::size_t p = 1 + random() % (kPoses - 1);
    const std::uint32_t from = route[p - 1], to = route[p];
    switch (k % 5) {
      case 0:
        changes.emplace_back([=](LayeredSearch& changed) { changed.blockNode(p, to); });
        break;
      case 1:
        changes.emplace_back([=](LayeredSearch& changed) { changed.markLosing(p, to); });
        break;
      case 2:
        changes.emplace_back([=](LayeredSearch& changed) { changed.blockStep(p, from, to); });
        break;
      case 3:
        changes.emplace_back([=](LayeredSearch& changed) { changed.avoidBelow(p, 1 + k % 3); });
        break;
      default:
        changes.emplace_back([=](LayeredSearch& changed) { changed.unblockSteps(p); });
    }
    changes.back()(search);
    LayeredSearch fresh(grid, kPoses);
    for (const auto& change : changes) change(fresh);
    ASSERT_EQ(search.cheapest(), fresh.cheapest()) << "change " << k;
  }
}

TEST(LayeredSearch, changesNothingWhereNothingIsBlocked) {
  const ChangeGrid grid({});
  EXPECT_TRUE(grid.change(grid.noChange()).isNone());
  for (const std::uint32_t node : LayeredSearch(grid, 3).cheapest()) EXPECT_EQ(node, grid.noChange());
}

TEST(ChangeGrid, refusesWhatCannotBeGone) {
  const auto refused = [](const ChangeLimits& limits) {
    try {
      const ChangeGrid grid(limits);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused({}), "");
  EXPECT_NE(refused({.tilt = -1}).find("tilt"), std::string::npos);
  EXPECT_NE(refused({.slide_grid = 3, .slide_per_pose = 2}).find("slide"), std::string::npos);
  EXPECT_NE(refused({.retract_grid = 0}).find("retraction"), std::string::npos);
  EXPECT_NE(refused({.tilt = 180, .tilt_grid = 0.01}).find("too many"), std::string::npos);
}

TEST(ChangeGrid, changedPoseGoesWhereItSays) {
  Pose pose;
  pose.rotation = Mat3(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()));
  pose.translation = Vec3(10, 20, 30);
  const Vec3 off = Vec3(0, 1, 1).normalized();
  const Pose slid = changedPose(pose, off, {.slide = 2.0});
  EXPECT_NEAR((slid.translation - pose * Vec3(0, 0, 2)).norm(), 0.0, 1e-12);
  const Pose lifted = changedPose(pose, off, {.retract = 0.4});
  EXPECT_NEAR((lifted.translation - pose.translation - 0.4 * off).norm(), 0.0, 1e-12);
  const Pose retracted = changedPose(pose, off, {.retract = 5.0});
  EXPECT_NEAR((retracted.translation - pose * Vec3(4, 0, 0) - off).norm(), 0.0, 1e-12);
  const Pose tilted = changedPose(pose, off, {.tilt = 90.0});
  EXPECT_NEAR((tilted * Vec3(1, 0, 0) - pose * Vec3(0, 1, 0)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace octoblisk::demos
