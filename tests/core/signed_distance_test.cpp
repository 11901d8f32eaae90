// Compares the signed distance with closed forms, finite differences, and the two queries that it combines.
#include "octoblisk/signed_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/solid.h"
#include "octoblisk/batch.h"
#include "octoblisk/motion.h"
#include "octoblisk/path_query.h"
#include "shared/brute_force.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::SharedMesh;

Pose shift(double x, double y, double z) { return {Mat3::Identity(), Vec3(x, y, z)}; }
Mat3 turn(const Vec3& axis, double angle) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

TEST(SignedDistance, ofBoxes_vs_closedForm) {
  const Solid a(testing::boxMesh({5, 5, 5})), b(testing::boxMesh({1, 1, 1}));
  for (const double gap : {3.0, 0.1, 1e-6, -1e-6, -0.1, -0.9}) {
    const SignedDistance found = signedDistance(a.surface, b.surface, shift(0.3, -0.2, 6.0 + gap));
    EXPECT_NEAR(found.distance, gap, 2e-9);
    EXPECT_NEAR((found.point_on_a - found.point_on_b).norm(), std::abs(gap), 2e-9);
    EXPECT_LT((found.by_translation - Vec3::UnitZ()).norm(), 1e-6);
    EXPECT_LT((found.normal - Vec3::UnitZ()).norm(), 1e-6);
  }
  const SignedDistance diagonal = signedDistance(a.surface, b.surface, shift(7, 8, 9));
  EXPECT_NEAR(diagonal.distance, Vec3(1, 2, 3).norm(), 1e-12);
  EXPECT_LT((diagonal.normal - Vec3(1, 2, 3).normalized()).norm(), 1e-12);
}

TEST(SignedDistance, ofATippedBox_vs_closedForm) {
  // One corner is nearest or deepest, so the derivative is that of its height.
  const Solid a(testing::boxMesh({50, 50, 5})), b(testing::boxMesh({1, 2, 3}));
  std::mt19937_64 random(110);
  for (int i = 0; i < 60; ++i) {
    Pose pose{testing::randomRotation(random), testing::randomPoint(random, 20.0)};
    Vec3 lowest = Vec3::Zero();
    for (const Vec3& vertex : b.mesh->vertices()) {
      if ((pose.rotation * vertex).z() < lowest.z()) lowest = pose.rotation * vertex;
    }
    const double height = (i % 2 ? 1.0 : -1.0) * std::pow(10.0, testing::uniform(random, -6.0, -0.5));
    pose.translation.z() = 5.0 + height - lowest.z();
    for (const bool exchange : {false, true}) {
      const SignedDistance found = exchange ? signedDistance(b.surface, a.surface, pose.inverse())
                                            : signedDistance(a.surface, b.surface, pose);
      ASSERT_NEAR(found.distance, height, 1e-7) << i;
      if (exchange) {
        ASSERT_LT((found.normal + pose.rotation.transpose() * Vec3::UnitZ()).norm(), 1e-7) << i;
      } else {
        ASSERT_LT((found.by_translation - Vec3::UnitZ()).norm(), 1e-7) << i;
        ASSERT_LT((found.by_rotation - lowest.cross(Vec3::UnitZ())).norm(), 1e-6) << i;
      }
    }
  }
}

TEST(SignedDistance, ofBallsAndRings_vs_closedForm) {
  // Meshes inscribed in round bodies, within the error of the facets.
  std::mt19937_64 random(111);
  const Solid ball(testing::bumpySphere(random, 1.0, 0.0, 64)), ring(testing::torus(2, 0.8, 128, 64));
  for (const double gap : {2.0, 0.1, 0.01, -0.01, -0.1, -0.4}) {
    const Vec3 along = testing::randomRotation(random).col(0);
    const Pose pose{testing::randomRotation(random), (2.0 + gap) * along};
    const SignedDistance balls = signedDistance(ball.surface, ball.surface, pose);
    EXPECT_NEAR(balls.distance, gap, 5e-3);
    EXPECT_LT((balls.normal - along).norm(), 0.1);
    // Coaxial rings, one over the other.
    const SignedDistance rings =
        signedDistance(ring.surface, ring.surface, {turn(Vec3::UnitZ(), 0.3), Vec3(0, 0, 1.6 + gap)});
    EXPECT_NEAR(rings.distance, gap, 5e-3);
    EXPECT_LT((rings.normal - Vec3::UnitZ()).norm(), 0.1);
    // A ball in a ring's hole, off its axis.
    const SignedDistance in_hole = signedDistance(ring.surface, ball.surface, shift(0.2 - gap, 0, 0));
    if (gap < 0.2) {
      EXPECT_NEAR(in_hole.distance, gap, 5e-3);
      EXPECT_LT((in_hole.normal + Vec3::UnitX()).norm(), 0.1);
    }
  }
}

/// The pose after a small displacement and a small rotation about the origin of B's frame.
Pose nearby(const Pose& pose, const Eigen::Matrix<double, 6, 1>& by) {
  const Vec3 by_turn = by.tail<3>();
  const double angle = by_turn.norm();
  const Mat3 rotation = angle == 0.0 ? Mat3(Mat3::Identity()) : turn(by_turn / angle, angle);
  return {rotation * pose.rotation, pose.translation + by.head<3>()};
}

TEST(SignedDistance, derivative_vs_finiteDifferences) {
  std::mt19937_64 random(112);
  const Solid ring(testing::torus(2, 0.8, 16, 10)), ball(testing::bumpySphere(random, 1.0, 0.5, 12)),
      block(testing::boxMesh({0.4, 0.9, 1.6}));
  const auto solids = std::array{&ring, &ball, &block};
  int apart = 0, in = 0, mean_of_feet = 0, kinks = 0;
  for (const Solid* a : solids) {
    for (const Solid* b : solids) {
      for (int i = 0; i < 50; ++i) {
        const Pose pose = testing::randomPose(random, a == &ring || b == &ring ? 3.0 : 1.9);
        PathQuery query(a->surface, b->surface);
        // At greater depths ties are common, because the deepest point lies on the other body's medial axis.
        if (query.signedDistance(pose, {.tolerance = 1e-3}).distance < -0.35) continue;
        const SignedDistanceOptions fine_depths{.tolerance = 1e-9};
        const SignedDistance found = query.signedDistance(pose, fine_depths);
        Eigen::Matrix<double, 6, 1> derivative;
        derivative << found.by_translation, found.by_rotation;
        const auto difference = [&](const Eigen::Matrix<double, 6, 1>& by) {
          return 0.5 * (query.signedDistance(nearby(pose, by), fine_depths).distance -
                        query.signedDistance(nearby(pose, -by), fine_depths).distance);
        };
        bool is_smooth = true, agrees = true;
        for (int k = 0; k < 6; ++k) {
          Eigen::Matrix<double, 6, 1> by = Eigen::Matrix<double, 6, 1>::Zero();
          by[k] = 1e-4;
          const double coarse = difference(by) / 1e-4;
          by[k] = 1e-5;
          const double fine = difference(by) / 1e-5;
          // If the derivative jumps within the coarse step, the results of the two steps differ.
          is_smooth &= std::abs(coarse - fine) < 2e-3;
          agrees &= std::abs(fine - derivative[k]) < 2e-3;
        }
        kinks += !is_smooth;
        if (!is_smooth) continue;
        EXPECT_TRUE(agrees) << i << ' ' << found.distance << ' ' << derivative.transpose();
        ++(found.distance > 0.0 ? apart : in);
        mean_of_feet += found.distance < 0.0 && found.by_translation.norm() < 1.0 - 1e-6;
      }
    }
  }
  EXPECT_GE(apart, 60);
  EXPECT_GE(in, 60);
  EXPECT_GE(mean_of_feet, 10);
  EXPECT_LE(kinks, 20);
}

TEST(SignedDistance, isTheQueriesThatItJoins) {
  std::mt19937_64 random(113);
  const Solid ring(testing::torus(2, 0.8, 16, 10)), ball(testing::bumpySphere(random, 1.0, 0.5, 12)),
      pearl(testing::bumpySphere(random, 0.3, 0.1, 8)), sheet(testing::waveSheet(1, 0.1, 8));
  const auto solids = std::array{&ring, &ball, &pearl, &sheet};
  DepthQuery depth;
  int positive = 0, negative = 0, contained = 0;
  for (const Solid* a : solids) {
    for (const Solid* b : solids) {
      if (a == &sheet && b == &sheet) continue;
      PathQuery query(a->surface, b->surface);
      for (int i = 0; i < 30; ++i) {
        const Pose pose = testing::randomPose(random, i % 3 ? 2.0 : 0.4);
        const SignedDistance found = query.signedDistance(pose, {.tolerance = 1e-7});
        const double clearance = distance(a->tree, b->tree, pose).distance;
        const GougeDepth of_b = depth.deepest(a->surface, b->surface, pose, 1e-7),
                         of_a = depth.deepest(b->surface, a->surface, pose.inverse(), 1e-7);
        const bool b_goes_in = a != &sheet && of_b.gouging == Gouging::found,
                   a_goes_in = b != &sheet && of_a.gouging == Gouging::found;
        const bool meet = b_goes_in || a_goes_in;
        const double deeper = std::max(b_goes_in ? of_b.depth : 0.0, a_goes_in ? of_a.depth : 0.0);
        ASSERT_EQ(found.distance, meet ? -deeper : clearance);
        ASSERT_NEAR((found.point_on_a - found.point_on_b).norm(), std::abs(found.distance), 1e-12);
        const Vec3 on_b = pose.inverse() * found.point_on_b;
        ASSERT_LT(testing::bruteForceDistance(a->mesh->triangle(found.triangle_a), found.point_on_a), 1e-12);
        ASSERT_LT(testing::bruteForceDistance(b->mesh->triangle(found.triangle_b), on_b), 1e-12);
        ASSERT_NEAR(found.normal.norm(), 1.0, 1e-12);
        ++(found.distance > 0.0 ? positive : negative);
        contained += meet && clearance > 0.0;
      }
    }
  }
  EXPECT_GE(positive, 100);
  EXPECT_GE(negative, 100);
  EXPECT_GE(contained, 10);
}

TEST(SignedDistance, isTheSameOverThreadsAndAlongAPath) {
  std::mt19937_64 random(114);
  const Solid ring(testing::torus(2, 0.8, 16, 10)), ball(testing::bumpySphere(random, 1.0, 0.5, 12));
  const Motion motion{shift(0, 0, 4), testing::randomPose(random, 1.0)};
  std::vector<Pose> path;
  for (int i = 0; i < 200; ++i) path.push_back(motion.at(i / 200.0));
  const auto expected = signedDistanceAll(ring.surface, ball.surface, path, {}, 1);
  int in = 0;
  for (const int threads : {2, 3}) {
    const auto found = signedDistanceAll(ring.surface, ball.surface, path, {}, threads);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
      ASSERT_EQ(found[i].distance, expected[i].distance);
      ASSERT_EQ(found[i].by_rotation, expected[i].by_rotation);
      ASSERT_EQ(found[i].distance, signedDistance(ring.surface, ball.surface, path[i]).distance);
      in += found[i].distance < 0.0;
    }
  }
  EXPECT_GT(in, 50);
  EXPECT_LT(in, 350);
}

TEST(SignedDistance, refusesWhatHasNoInside) {
  const Solid sheet(testing::waveSheet(1, 0.1, 8)), box(testing::boxMesh({1, 1, 1}));
  EXPECT_THROW(signedDistance(sheet.surface, sheet.surface, {}), std::invalid_argument);
  EXPECT_THROW(signedDistanceAll(sheet.surface, sheet.surface, std::vector<Pose>(1)), std::invalid_argument);
  PathQuery of_trees(box.tree, box.tree);
  EXPECT_THROW(of_trees.signedDistance({}), std::logic_error);
}

}  // namespace
}  // namespace octoblisk
