// Compares queries along a path with the same queries made independently.
#include "octoblisk/path_query.h"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "octoblisk/motion.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

static_assert(std::is_copy_constructible_v<PathQuery>);

/// A path of fine steps along motions between random poses, with a jump between two motions.
std::vector<Pose> finePath(std::mt19937_64& random, int motions, int steps, double spread) {
  std::vector<Pose> path;
  for (int m = 0; m < motions; ++m) {
    const Motion motion{testing::randomPose(random, spread), testing::randomPose(random, spread)};
    const double part = testing::uniform(random, 0.05, 0.5);
    for (int step = 0; step < steps; ++step) path.push_back(motion.at(part * step / steps));
  }
  return path;
}

struct Bodies {
  ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 10));
  ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
};

TEST(PathQuery, collide_vs_eachOnItsOwn) {
  const Bodies bodies;
  std::mt19937_64 random(90);
  const std::vector<Pose> path = finePath(random, 30, 100, 1.3);
  PathQuery query(bodies.fan, bodies.ring);
  std::size_t hits = 0, kept = 0;
  std::optional<TrianglePair> last;
  for (const Pose& pose : path) {
    const auto found = query.collide(pose);
    ASSERT_EQ(found.has_value(), collide(bodies.fan, bodies.ring, pose).has_value());
    hits += found.has_value();
    kept += found && found == last;
    if (found) {
      std::vector<TrianglePair> all;
      touchingPairs(bodies.fan, bodies.ring, pose, all);
      ASSERT_TRUE(std::ranges::binary_search(all, *found));
    }
    last = found;
  }
  EXPECT_GT(hits, path.size() * 3 / 10);
  EXPECT_LT(hits, path.size() * 7 / 10);
  EXPECT_GT(kept, hits / 2);  // the witness is often valid
}

TEST(PathQuery, distance_vs_eachOnItsOwn) {
  const Bodies bodies;
  std::mt19937_64 random(91);
  const std::vector<Pose> path = finePath(random, 30, 40, 1.3);
  PathQuery query(bodies.fan, bodies.ring);
  std::size_t hits = 0;
  for (const Pose& pose : path) {
    const Clearance expected = distance(bodies.fan, bodies.ring, pose), found = query.distance(pose);
    ASSERT_NEAR(found.distance, expected.distance, 1e-12);
    ASSERT_EQ(found.distance == 0.0, expected.distance == 0.0);
    ASSERT_NEAR((found.point_on_a - found.point_on_b).norm(), found.distance, 1e-12);
    hits += found.distance == 0.0;
  }
  EXPECT_GT(hits, path.size() * 3 / 10);
  EXPECT_LT(hits, path.size() * 7 / 10);
}

TEST(PathQuery, mixedWithBounds_vs_eachOnItsOwn) {
  const Bodies bodies;
  std::mt19937_64 random(92);
  const std::vector<Pose> path = finePath(random, 40, 60, 1.6);
  PathQuery query(bodies.fan, bodies.ring);
  int hits = 0, beyond = 0, within = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Pose& pose = path[i];
    if (random() % 2) {
      const bool found = query.collide(pose).has_value();
      ASSERT_EQ(found, collide(bodies.fan, bodies.ring, pose).has_value()) << i;
      hits += found;
      continue;
    }
    const double bound = random() % 3 ? testing::uniform(random, 0.0, 0.4) : 1e9;
    const double tolerance = random() % 3 ? 0.0 : 0.01;
    const Clearance exact = distance(bodies.fan, bodies.ring, pose);
    const Clearance found = query.distance(pose, {.upper_bound = bound, .tolerance = tolerance});
    if (tolerance == 0.0) {
      ASSERT_EQ(found.found(), exact.distance < bound) << i;
      ASSERT_NEAR(found.distance, std::min(bound, exact.distance), 1e-12) << i;
    } else {
      ASSERT_GE(found.distance, std::min(bound, exact.distance) - 1e-12) << i;
      ASSERT_LE(found.distance, exact.distance + tolerance + 1e-12) << i;
    }
    (found.found() ? within : beyond) += 1;
  }
  EXPECT_GT(hits, 200);
  EXPECT_GT(within, 200);
  EXPECT_GT(beyond, 200);
}

TEST(PathQuery, aWayAsLongAsTheClearanceIsNotTakenForClear) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const auto along = [](double gap) { return Pose{Mat3::Identity(), Vec3(2.0 + gap, 0.5, 0.25)}; };
  for (const double gap : {0.5, 0.25, 1e-3, 1e-6}) {
    PathQuery query(box, box);
    EXPECT_NEAR(query.distance(along(gap)).distance, gap, 1e-14);
    EXPECT_FALSE(query.collide(along(1e-3 * gap)));
    EXPECT_TRUE(query.collide(along(0.0)));
    EXPECT_TRUE(query.collide(along(-1e-3 * gap)));
    EXPECT_NEAR(query.distance(along(gap)).distance, gap, 1e-14);
    EXPECT_EQ(query.distance(along(0.3 * gap), {.upper_bound = 0.2 * gap}).distance, 0.2 * gap);
    EXPECT_FALSE(query.distance(along(0.3 * gap), {.upper_bound = 0.2 * gap}).found());
    EXPECT_NEAR(query.distance(along(0.3 * gap), {.upper_bound = 0.4 * gap}).distance, 0.3 * gap, 1e-14);
  }
}

TEST(PathQuery, aDistanceWithinAToleranceProvesThatMuchLess) {
  const Bodies bodies;
  std::mt19937_64 random(93);
  int too_large = 0, meeting = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pose pose = testing::randomPose(random, 2.5);
    const Clearance exact = distance(bodies.fan, bodies.ring, pose);
    PathQuery query(bodies.fan, bodies.ring);
    const double found = query.distance(pose, {.tolerance = 0.3}).distance;
    if (exact.distance == 0.0 || found < exact.distance + 0.02) continue;
    ++too_large;
    // Moves straight towards the nearest point: slightly farther than is free, but less than announced.
    const Vec3 way = (exact.point_on_a - exact.point_on_b) * ((exact.distance + 0.01) / exact.distance);
    const Pose nearer{pose.rotation, pose.translation + way};
    const bool expected = collide(bodies.fan, bodies.ring, nearer).has_value();
    ASSERT_EQ(query.collide(nearer).has_value(), expected) << i;
    meeting += expected;
  }
  EXPECT_GT(too_large, 50);
  EXPECT_GT(meeting, too_large / 2);
}

TEST(PathQuery, theOptionsHintServesTheFirstPoseAndAPairOutOfRangeNone) {
  const Bodies bodies;
  const Pose pose{Mat3::Identity(), Vec3(4, 0, 0)};
  const double expected = distance(bodies.fan, bodies.ring, pose).distance;
  PathQuery query(bodies.fan, bodies.ring);
  EXPECT_EQ(query.distance(pose, {.hint = {12345678, 3}}).distance, expected);
  EXPECT_EQ(query.distance(pose).distance, expected);
  EXPECT_FALSE(query.collide(pose));
}

TEST(PathQuery, afterATouchAPoseThatIsNotFiniteMeetsNothing) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const Surface surface(box);
  const Pose touching{Mat3::Identity(), Vec3(1, 0.25, 0.125)};
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int place = 0; place < 12; ++place) {
      Pose pose = touching;
      (place < 9 ? pose.rotation(place / 3, place % 3) : pose.translation[place - 9]) = bad;
      PathQuery collisions(box, box), distances(box, box), signed_distances(surface, surface);
      EXPECT_TRUE(collisions.collide(touching));
      EXPECT_FALSE(collisions.collide(pose)) << place;
      EXPECT_EQ(distances.distance(touching).distance, 0.0);
      EXPECT_EQ(distances.distance(pose).distance, std::numeric_limits<double>::infinity()) << place;
      EXPECT_FALSE(distance(box, box, pose, {.hint = {0, 0}}).found()) << place;
      signed_distances.signedDistance(touching);
      EXPECT_EQ(signed_distances.signedDistance(pose).distance, std::numeric_limits<double>::infinity())
          << place;
    }
  }
}

}  // namespace
}  // namespace octoblisk
