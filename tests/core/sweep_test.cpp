// Compares times of impact with closed forms and dense sampling.
#include "octoblisk/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/convex.h"
#include "shared/meshes.h"
#include "shared/posed_vertices.h"

namespace octoblisk {
namespace {

using testing::uniform;

constexpr double kTolerance = 1e-3;
constexpr double kSlack = SweepOptions{}.slack;

/// Expects the impact between the fractions at which the distance falls to (1 + slack) · tolerance and to the
/// tolerance. `error` allows for rounding.
void expectBetween(const TimeOfImpact& impact, double at_slack, double at_tolerance, double error = 1e-9) {
  EXPECT_TRUE(impact.converged);
  EXPECT_GE(impact.fraction, at_slack - error);
  EXPECT_LE(impact.fraction, at_tolerance + error);
}

/// Returns the impact of a body that moves straight onto a floor, whose top has height 1. Expects that of the
/// closed form. `lowest` is the height of the body's lowest point at the start.
template <typename Body>
std::optional<TimeOfImpact> impactOnFloor(const ClusteredOctree& floor, const Body& body, const Pose& from,
                                          const Vec3& way, double lowest, double error) {
  const double gap = lowest - 1.0;
  const auto impact = sweep(floor, body, Motion(from, {from.rotation, from.translation + way}), kTolerance);
  const double at_tolerance = (gap - kTolerance) / -way.z(),
               at_slack = (gap - (1.0 + kSlack) * kTolerance) / -way.z();
  if (at_tolerance <= 1.0 - 1e-9) {
    EXPECT_TRUE(impact);
  } else if (at_slack > 1.0 + 1e-9) {
    EXPECT_FALSE(impact);
  }
  if (!impact) return impact;
  expectBetween(*impact, at_slack, at_tolerance);
  EXPECT_NEAR(impact->clearance.distance, gap + way.z() * impact->fraction, error);
  EXPECT_NEAR(impact->clearance.point_on_a.z(), 1.0, 0.1 * error);
  return impact;
}

TEST(Sweep, anythingOntoAFloor_vs_closedForm) {
  std::mt19937_64 random(80);
  const ClusteredOctree floor = ClusteredOctree::build(testing::boxMesh({100, 100, 1}));
  int hits = 0;
  constexpr int kCases = 300;
  const auto ring = testing::torus(3, 1, 24, 12), box = testing::boxMesh({2, 0.1, 1});
  const ClusteredOctree trees[] = {ClusteredOctree::build(ring), ClusteredOctree::build(box)};
  for (int i = 0; i < kCases; ++i) {
    const ClusteredOctree& body = trees[i % 2];
    const Pose from{testing::randomRotation(random), Vec3(0, 0, uniform(random, 6.0, 28.0))};
    const Vec3 way{uniform(random, -40, 40), uniform(random, -40, 40), uniform(random, -30, 0)};
    const double lowest = testing::lowestZ(body.mesh(), from);
    const auto impact = impactOnFloor(floor, body, from, way, lowest, 1e-11);
    hits += impact.has_value();
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

TEST(Sweep, noSheetIsPassedThrough) {
  // Two triangles without thickness, and a small box that moves a thousand times its size per step.
  const auto sheet =
      std::make_shared<const TriangleMesh>(std::vector<Vec3>{{0, -2, -2}, {0, 2, -2}, {0, 2, 2}, {0, -2, 2}},
                                           std::vector<TriangleMesh::Indices>{{0, 1, 2}, {0, 2, 3}});
  const ClusteredOctree wall = ClusteredOctree::build(sheet);
  const ClusteredOctree shot = ClusteredOctree::build(testing::boxMesh({0.05, 0.05, 0.05}));
  std::mt19937_64 random(81);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const double start = uniform(random, -99.0, -1.0), height = uniform(random, -4.0, 4.0);
    const Motion motion(Pose{Mat3::Identity(), Vec3(start, height, 0)},
                        Pose{Mat3::Identity(), Vec3(start + 100.0, height, 0)});
    ASSERT_FALSE(collide(wall, shot, motion.at(0.0)));
    ASSERT_FALSE(collide(wall, shot, motion.at(1.0)));
    const double past = std::abs(height) - 2.05;  // the sheet's edge
    if (past > 0.0 && past < 2.0 * kTolerance) continue;
    const auto impact = sweep(wall, shot, motion, kTolerance);
    ASSERT_EQ(impact.has_value(), past <= 0.0) << height;
    if (!impact) continue;
    ++hits;
    const double gap = -start - 0.05;
    expectBetween(*impact, (gap - (1.0 + kSlack) * kTolerance) / 100.0, (gap - kTolerance) / 100.0);
  }
  EXPECT_GT(hits, 60);
  EXPECT_LT(hits, 140);
}

TEST(Sweep, rodTurnsOntoACorner_vs_closedForm) {
  // The rod along x turns counter-clockwise about z until it meets the lower right edge of a block. The edge
  // is at angle φ and distance ρ, so it is ρ sin(φ − θ) − thickness above the rod.
  constexpr double kThickness = 0.05, kLength = 10.0;
  const ClusteredOctree rod = ClusteredOctree::build(testing::boxMesh({kLength, kThickness, 1.0}));
  const ClusteredOctree block = ClusteredOctree::build(testing::boxMesh({0.5, 0.5, 0.5}));
  std::mt19937_64 random(82);
  int hits = 0;
  constexpr int kCases = 200;
  for (int i = 0; i < kCases; ++i) {
    const double phi = uniform(random, 0.3, 1.5), rho = uniform(random, 2.0, 9.0);
    const double turn = uniform(random, 0.2, 1.6);
    const Vec3 corner(rho * std::cos(phi), rho * std::sin(phi), 0.0);
    const Vec3 block_center = corner + Vec3(-0.5, 0.5, 0.0);
    const Pose rod_in_block{Mat3::Identity(), -block_center};
    const Motion motion = Motion::about(rod_in_block, -block_center, Vec3(0, 0, turn));
    const auto angleAt = [&](double distance) { return phi - std::asin((kThickness + distance) / rho); };
    const double at_tolerance = angleAt(kTolerance) / turn,
                 at_slack = angleAt((1.0 + kSlack) * kTolerance) / turn;
    const auto impact = sweep(block, rod, motion, kTolerance);
    if (at_tolerance <= 1.0 - 1e-9) {
      ASSERT_TRUE(impact) << i;
    } else if (at_slack > 1.0 + 1e-9) {
      ASSERT_FALSE(impact) << i;
    }
    if (!impact) continue;
    ++hits;
    expectBetween(*impact, at_slack, at_tolerance);
    EXPECT_NEAR(impact->clearance.point_on_a.x(), 0.5, 1e-9);
    EXPECT_NEAR(impact->clearance.point_on_a.y(), -0.5, 1e-9);
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

TEST(Sweep, curvedMotions_vs_denseSampling) {
  const ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 10));
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.4, 0.1, 20, 12));
  std::mt19937_64 random(83);
  int hits = 0, met = 0, cases = 0;
  while (cases < 150) {
    const Pose from = testing::randomPose(random, 2.5), to = testing::randomPose(random, 2.5);
    if (collide(fan, ring, from)) continue;
    ++cases;
    const Motion motion(from, to, testing::randomPoint(random, 0.5));
    const auto impact = sweep(fan, ring, motion, kTolerance);
    hits += impact.has_value();
    if (impact) {
      ASSERT_TRUE(impact->converged);
      const Clearance here = distance(fan, ring, motion.at(impact->fraction));
      ASSERT_EQ(here.distance, impact->clearance.distance);
      ASSERT_LE(here.distance, (1.0 + kSlack) * kTolerance + 1e-10);
    }
    constexpr int kSamples = 500;
    bool any = false;
    for (int sample = 0; sample <= kSamples; ++sample) {
      const double fraction = static_cast<double>(sample) / kSamples;
      if (impact && fraction >= impact->fraction) {
        any |= collide(fan, ring, motion.at(fraction)).has_value();
        continue;
      }
      ASSERT_FALSE(collide(fan, ring, motion.at(fraction))) << cases << ", at " << fraction;
      if (sample % 10 == 0) {
        ASSERT_GT(distance(fan, ring, motion.at(fraction)).distance, kTolerance);
      }
    }
    met += any;
  }
  EXPECT_GT(hits, cases * 3 / 10);
  EXPECT_LT(hits, cases * 7 / 10);
  EXPECT_GT(met, hits * 8 / 10);  // most impacts are real hits, not near misses
}

TEST(Sweep, twoMovingBodies_vs_denseSampling) {
  const ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 10));
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.4, 0.1, 20, 12));
  std::mt19937_64 random(88);
  int hits = 0, met = 0, cases = 0;
  while (cases < 150) {
    const Vec3 common = testing::randomPoint(random, 50.0);
    const auto screw = [&](double turn) {
      const Pose begin = testing::randomPose(random, 1.6);
      const Vec3 center = testing::randomPoint(random, 1.0), turned = testing::randomPoint(random, turn);
      return Motion::about(begin, center, turned, common + testing::randomPoint(random, 1.0));
    };
    const Motion fan_in_world = screw(4.0), ring_in_world = screw(9.0);
    const auto poseAt = [&](double fraction) {
      return fan_in_world.at(fraction).inverse() * ring_in_world.at(fraction);
    };
    if (collide(fan, ring, poseAt(0.0))) continue;
    ++cases;
    const auto impact = sweep(fan, ring, fan_in_world, ring_in_world, kTolerance);
    hits += impact.has_value();
    if (impact) {
      ASSERT_TRUE(impact->converged);
      const Clearance here = distance(fan, ring, poseAt(impact->fraction));
      ASSERT_EQ(here.distance, impact->clearance.distance);
      ASSERT_LE(here.distance, (1.0 + kSlack) * kTolerance + 1e-9);
    }
    constexpr int kSamples = 500;
    bool any = false;
    for (int sample = 0; sample <= kSamples; ++sample) {
      const double fraction = static_cast<double>(sample) / kSamples;
      if (impact && fraction >= impact->fraction) {
        any |= collide(fan, ring, poseAt(fraction)).has_value();
        continue;
      }
      ASSERT_FALSE(collide(fan, ring, poseAt(fraction))) << cases << ", at " << fraction;
      if (sample % 10 == 0) {
        ASSERT_GT(distance(fan, ring, poseAt(fraction)).distance, kTolerance);
      }
    }
    met += any;
  }
  EXPECT_GT(hits, cases * 3 / 10);
  EXPECT_LT(hits, cases * 7 / 10);
  EXPECT_GT(met, hits * 8 / 10);
}

TEST(Sweep, twoMovingBodies_vs_oneOfThem) {
  // The sweep depends only on the relative motion of A and B.
  const ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 10));
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.4, 0.1, 20, 12));
  std::mt19937_64 random(88);
  int hits = 0;
  constexpr int kCases = 100;
  for (int i = 0; i < kCases; ++i) {
    const Pose a = testing::randomPose(random, 5.0), from = testing::randomPose(random, 2.0);
    const Vec3 way = testing::randomPoint(random, 3.0), common = testing::randomPoint(random, 40.0);
    const Motion b_in_a(from, {from.rotation, from.translation + way});
    const auto alone = sweep(fan, ring, b_in_a, kTolerance);
    const Pose b = a * from;
    const auto both = sweep(fan, ring, Motion(a, {a.rotation, a.translation + common}),
                            Motion(b, {b.rotation, b.translation + common + a.rotation * way}), kTolerance);
    ASSERT_EQ(alone.has_value(), both.has_value());
    if (!alone) continue;
    ++hits;
    ASSERT_NEAR(alone->fraction, both->fraction, 1e-6);
    ASSERT_NEAR(alone->clearance.distance, both->clearance.distance, 1e-6);
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 8 / 10);
}

TEST(Sweep, oneThatTouchesAtTheStartMeetsThere) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const Pose touching{Mat3::Identity(), Vec3(2, 0, 0)}, away{Mat3::Identity(), Vec3(9, 0, 0)};
  const auto impact = sweep(box, box, Motion(touching, away), kTolerance);
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, 0.0);
  EXPECT_EQ(impact->clearance.distance, 0.0);
  EXPECT_TRUE(impact->converged);
  EXPECT_NE(impact->clearance.triangles(), TrianglePair{});
  EXPECT_FALSE(sweep(box, box, Motion(away, away), kTolerance));
}

TEST(Sweep, aBodyInsideAHollowOneIsFreeUntilItMeetsTheWall) {
  const ClusteredOctree hollow = ClusteredOctree::build(testing::boxMesh({2, 2, 2}));
  const ClusteredOctree inner = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const auto impact = sweep(hollow, inner, Motion(Pose{}, {Mat3::Identity(), Vec3(4, 0, 0)}), kTolerance);
  ASSERT_TRUE(impact);
  expectBetween(*impact, (1.0 - (1.0 + kSlack) * kTolerance) / 4.0, (1.0 - kTolerance) / 4.0);
}

TEST(Sweep, usedUpStepsAreReported) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  // A body that slides past at twice the tolerance is free, but the search advances only in small steps.
  const double height = 2.0 + 2.0 * kTolerance;
  const Motion past(Pose{Mat3::Identity(), Vec3(0, 0, height)}, Pose{Mat3::Identity(), Vec3(1, 0, height)});
  EXPECT_FALSE(sweep(box, box, past, kTolerance, {.max_steps = 1010}));
  const auto stopped = sweep(box, box, past, kTolerance, {.max_steps = 100});
  ASSERT_TRUE(stopped);
  EXPECT_FALSE(stopped->converged);
  EXPECT_NEAR(stopped->fraction, 99 * kTolerance, 1e-6);
  EXPECT_NEAR(stopped->clearance.distance, 2.0 * kTolerance, 1e-12);
}

TEST(Sweep, theTightestToleranceStillEnds) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const Motion fall(Pose{Mat3::Identity(), Vec3(0.3, 0.2, 5)}, Pose{Mat3::Identity(), Vec3(0, 0, 0)});
  const auto impact = sweep(box, box, fall, 1e-300);
  ASSERT_TRUE(impact);
  EXPECT_TRUE(impact->converged);
  EXPECT_NEAR(impact->fraction, 0.6, 1e-10);
  EXPECT_FALSE(collide(box, box, fall.at(impact->fraction)));
}

TEST(ConvexSweep, anythingOntoAFloor_vs_closedForm) {
  std::mt19937_64 random(84);
  const ClusteredOctree floor = ClusteredOctree::build(testing::boxMesh({100, 100, 1}));
  const ConvexHull ball({Vec3(0.2, 0, 0)}, 1.5), capsule({Vec3(-2, 0, 0), Vec3(2, 1, 0)}, 0.4);
  const ConvexBox box({Vec3(0, 1, 0), testing::randomRotation(random), Vec3(2, 0.1, 1)});
  const Convex* const bodies[] = {&ball, &capsule, &box};
  int hits = 0;
  constexpr int kCases = 300;
  for (int i = 0; i < kCases; ++i) {
    const Convex& body = *bodies[i % 3];
    const Pose from{testing::randomRotation(random), Vec3(0, 0, uniform(random, 6.0, 28.0))};
    const Vec3 way{uniform(random, -40, 40), uniform(random, -40, 40), uniform(random, -30, 0)};
    double lowest = 1e9;
    for (const Vec3& point : body.points()) lowest = std::min(lowest, (from * point).z() - body.radius());
    const auto impact = impactOnFloor(floor, body, from, way, lowest, 1e-10);
    hits += impact.has_value();
    if (impact) {
      EXPECT_EQ(impact->clearance.triangle_b, kNoTriangle);
    }
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

/// A body known by its support function alone.
class Disk final : public Convex {
 public:
  Vec3 support(const Vec3& direction) const override {
    const double across = std::hypot(direction.x(), direction.y());
    if (!(across > 0.0)) return Vec3(0.5, 0, 0);
    return Vec3(direction.x() / across * 0.5, direction.y() / across * 0.5, 0.0);
  }
  double radius() const override { return 0.05; }
};

TEST(ConvexSweep, twoMovingBodies_vs_denseSampling) {
  const ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 10));
  std::mt19937_64 random(85);
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) points.push_back(testing::randomPoint(random, 0.4));
  const ConvexHull hull(points), ball({Vec3::Zero()}, 0.4);
  const ConvexBox box({Vec3::Zero(), Mat3::Identity(), Vec3(0.5, 0.3, 0.1)});
  const Disk disk;
  const Convex* const bodies[] = {&hull, &ball, &box, &disk};
  std::vector<Contact> found;
  int hits = 0, met = 0, cases = 0;
  while (cases < 160) {
    const Convex& body = *bodies[cases % 4];
    const Vec3 common = testing::randomPoint(random, 50.0);
    const auto screw = [&](double turn) {
      const Pose begin = testing::randomPose(random, 1.9);
      const Vec3 center = testing::randomPoint(random, 1.0), turned = testing::randomPoint(random, turn);
      return Motion::about(begin, center, turned, common + testing::randomPoint(random, 1.0));
    };
    const Motion fan_in_world = screw(4.0), body_in_world = screw(9.0);
    const auto within = [&](double fraction, double reach) {
      const Pose pose = fan_in_world.at(fraction).inverse() * body_in_world.at(fraction);
      contacts(fan, body, pose, reach, found);
      return !found.empty();
    };
    if (within(0.0, 0.0)) continue;
    ++cases;
    const auto impact = sweep(fan, body, fan_in_world, body_in_world, kTolerance);
    hits += impact.has_value();
    if (impact) {
      ASSERT_TRUE(impact->converged);
      ASSERT_TRUE(within(impact->fraction, (1.0 + kSlack) * kTolerance + 1e-9));
    }
    constexpr int kSamples = 300;
    bool any = false;
    for (int sample = 0; sample <= kSamples; ++sample) {
      const double fraction = static_cast<double>(sample) / kSamples;
      if (impact && fraction >= impact->fraction) {
        any |= within(fraction, 0.0);
        continue;
      }
      ASSERT_FALSE(within(fraction, kTolerance)) << cases << ", at " << fraction;
    }
    met += any;
  }
  EXPECT_GT(hits, cases * 3 / 10);
  EXPECT_LT(hits, cases * 7 / 10);
  EXPECT_GT(met, hits * 8 / 10);
}

TEST(ConvexSweep, noSheetIsPassedThrough) {
  const ClusteredOctree wall = ClusteredOctree::build(testing::boxMesh({1e-4, 2, 2}));
  const ConvexHull shot({Vec3::Zero()}, 0.05);
  std::mt19937_64 random(86);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const double start = uniform(random, -99.0, -1.0), height = uniform(random, -4.0, 4.0);
    const Motion motion(Pose{Mat3::Identity(), Vec3(start, height, 0)},
                        Pose{Mat3::Identity(), Vec3(start + 100.0, height, 0)});
    const double past = std::abs(height) - 2.05;  // the wall's edge
    if (past > 0.0 && past < 2.0 * kTolerance) continue;
    if (past <= 0.0 && past > -0.05) continue;  // the edge meets the side of the ball
    const auto impact = sweep(wall, shot, motion, kTolerance);
    ASSERT_EQ(impact.has_value(), past <= 0.0) << height;
    if (!impact) continue;
    ++hits;
    const double gap = -start - 0.05 - 1e-4;
    expectBetween(*impact, (gap - (1.0 + kSlack) * kTolerance) / 100.0, (gap - kTolerance) / 100.0);
  }
  EXPECT_GT(hits, 60);
  EXPECT_LT(hits, 140);
}

TEST(Sweep, nothingIsLookedForFromTheEndOn) {
  const ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 10));
  const ConvexBox box({Vec3::Zero(), Mat3::Identity(), Vec3(0.5, 0.3, 0.1)});
  std::mt19937_64 random(87);
  int hits = 0;
  for (int i = 0; i < 60; ++i) {
    const Motion motion(testing::randomPose(random, 2.5), testing::randomPose(random, 2.5));
    const auto impact = sweep(fan, box, motion, kTolerance);
    if (!impact || impact->fraction == 0.0) continue;
    ++hits;
    EXPECT_FALSE(sweep(fan, box, motion, kTolerance, {.until = impact->fraction * 0.999}));
    const auto again = sweep(fan, box, motion, kTolerance, {.until = impact->fraction * 1.001});
    ASSERT_TRUE(again);
    EXPECT_EQ(again->fraction, impact->fraction);
    EXPECT_EQ(again->clearance.distance, impact->clearance.distance);
  }
  EXPECT_GT(hits, 15);
}

}  // namespace
}  // namespace octoblisk
