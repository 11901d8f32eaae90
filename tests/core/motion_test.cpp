// Tests the guarantees of motions for their ends, their centre and every vertex.
#include "octoblisk/motion.h"

#include <gtest/gtest.h>

#include <numbers>

#include "octoblisk/convex.h"
#include "shared/meshes.h"
#include "shared/posed_vertices.h"

namespace octoblisk {
namespace {

TEST(Motion, goesFromPoseToPoseWithItsCentreStraight) {
  std::mt19937_64 random(70);
  for (int i = 0; i < 1000; ++i) {
    const Pose from = testing::randomPose(random, 5.0), to = testing::randomPose(random, 5.0);
    const Vec3 center = testing::randomPoint(random, 3.0);
    const Motion motion(from, to, center);
    ASSERT_EQ(motion.at(0.0).rotation, from.rotation);
    ASSERT_EQ(motion.at(0.0).translation, from.translation);
    ASSERT_TRUE(motion.at(1.0).rotation.isApprox(to.rotation, 1e-13));
    ASSERT_TRUE(motion.at(1.0).translation.isApprox(to.translation, 1e-12));
    ASSERT_LE(motion.angle(), std::numbers::pi);
    const double fraction = testing::uniform(random, 0.0, 1.0);
    const Vec3 straight = (1.0 - fraction) * (from * center) + fraction * (to * center);
    ASSERT_LT((motion.at(fraction) * center - straight).norm(), 1e-12);
  }
}

TEST(Motion, turnsAtConstantSpeed) {
  std::mt19937_64 random(71);
  for (int i = 0; i < 300; ++i) {
    const Motion motion{testing::randomPose(random, 5.0), testing::randomPose(random, 5.0)};
    const double fraction = testing::uniform(random, 0.0, 0.9);
    const Mat3 tenth = motion.at(fraction + 0.1).rotation * motion.at(fraction).rotation.transpose();
    ASSERT_NEAR(Eigen::AngleAxisd(tenth).angle(), 0.1 * motion.angle(), 1e-12);
  }
}

TEST(Motion, screwOfManyTurns) {
  const Motion screw = Motion::about(Pose{}, Vec3(1, 0, 7), Vec3(0, 0, 5 * std::numbers::pi), Vec3(0, 0, 10));
  // Two and a half turns about x = 1, y = 0, ten up.
  EXPECT_LT((screw.at(1.0) * Vec3(3, 0, 0) - Vec3(-1, 0, 10)).norm(), 1e-13);
  EXPECT_LT((screw.at(0.4) * Vec3(3, 0, 0) - Vec3(3, 0, 4)).norm(), 1e-13);
  EXPECT_LT((screw.at(0.1) * Vec3(3, 0, 0) - Vec3(1, 2, 1)).norm(), 1e-13);
}

TEST(Motion, noVertexGoesFartherThanTheBounds) {
  std::mt19937_64 random(72);
  int tight = 0, tight_displacements = 0, cases = 0;
  for (const auto& mesh : {testing::torus(3, 1, 24, 12), testing::boxMesh({10, 0.1, 0.2}), testing::fan(9, 8),
                           testing::soup(random, 30, 4, 1)}) {
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    const BodyBounds bounds(tree);
    for (int i = 0; i < 200; ++i, ++cases) {
      const Pose from = testing::randomPose(random, 4.0);
      const Vec3 way = testing::randomPoint(random, 3.0), center = testing::randomPoint(random, 9.0),
                 turn = testing::randomPoint(random, i % 2 ? 3.0 : 0.0);
      const Motion motion = Motion::about(from, center, turn, way);
      const double bound = motion.lengthBound(tree), start = testing::uniform(random, 0.0, 0.999);
      // Over a short part of the motion, path length and distance are equal.
      const Pose here = motion.at(start), next = motion.at(start + 1e-3);
      const double step = testing::greatestDisplacement(*mesh, here, next);
      ASSERT_LE(step, 1e-3 * bound * (1.0 + 1e-9));
      tight += step > 0.6e-3 * bound;
      const double far = testing::greatestDisplacement(*mesh, from, motion.at(1.0));
      ASSERT_LE(far, bound * (1.0 + 1e-9));
      ASSERT_LE(far, bounds.displacement(from, motion.at(1.0)) * (1.0 + 1e-12));
      ASSERT_LE(step, bounds.displacement(here, next) * (1.0 + 1e-9));
      tight_displacements += step > 0.6 * bounds.displacement(here, next);
    }
  }
  EXPECT_GT(tight, cases * 8 / 10);
  EXPECT_GT(tight_displacements, cases * 8 / 10);
}

/// The greatest change of the distance between a vertex of A and one of B.
double mostChange(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a, const Pose& next) {
  double most = 0.0;
  for (const Vec3& on_a : a.vertices()) {
    for (const Vec3& on_b : b.vertices()) {
      most = std::max(most, std::abs((next * on_b - on_a).norm() - (b_in_a * on_b - on_a).norm()));
    }
  }
  return most;
}

TEST(RelativeMotion, noDistanceChangesByMoreThanTheBound) {
  std::mt19937_64 random(73);
  const auto mesh_a = testing::boxMesh({3, 0.1, 0.2}), mesh_b = testing::torus(1, 0.3, 8, 4);
  const ClusteredOctree a = ClusteredOctree::build(mesh_a), b = ClusteredOctree::build(mesh_b);
  int tight = 0;
  constexpr int kCases = 800;
  for (int i = 0; i < kCases; ++i) {
    // One at rest, one that only turns, both turning, and both moving fast with a small relative motion.
    const Vec3 common = i % 4 == 3 ? testing::randomPoint(random, 500.0) : Vec3(Vec3::Zero());
    const auto screw = [&](bool still, bool turns) {
      const Vec3 turn = testing::randomPoint(random, turns ? 2.0 : 0.0);
      const Vec3 way = testing::randomPoint(random, still ? 0.0 : 3.0);
      const Pose begin = testing::randomPose(random, 4.0);
      return Motion::about(begin, testing::randomPoint(random, 5.0), turn, way + common);
    };
    const Motion motion_a = screw(i % 4 < 2, i % 4 == 2), motion_b = screw(i % 4 == 1, i % 4 > 0);
    const double bound = relativeLengthBound(a, motion_a, b, motion_b);
    ASSERT_NEAR(bound, relativeLengthBound(b, motion_b, a, motion_a), 1e-9 * (1.0 + bound));
    const auto poseAt = [&](double fraction) {
      return motion_a.at(fraction).inverse() * motion_b.at(fraction);
    };
    double fastest = 0.0;
    for (int part = 0; part < 5; ++part) {
      const double start = testing::uniform(random, 0.0, 0.999);
      const double change = mostChange(*mesh_a, *mesh_b, poseAt(start), poseAt(start + 1e-3));
      ASSERT_LE(change, 1e-3 * bound * (1.0 + 1e-7) + 1e-11) << i;
      fastest = std::max(fastest, change);
    }
    tight += fastest > 0.4e-3 * bound;
  }
  EXPECT_GT(tight, kCases * 7 / 10);
}

TEST(RelativeMotion, whatTwoBodiesDoTogetherIsNoMotion) {
  const ClusteredOctree body = ClusteredOctree::build(testing::boxMesh({3, 0.1, 0.2}));
  std::mt19937_64 random(74);
  for (int i = 0; i < 100; ++i) {
    const Pose pose_a = testing::randomPose(random, 4.0), pose_b = testing::randomPose(random, 4.0);
    const Vec3 turn = testing::randomPoint(random, 3.0), way = testing::randomPoint(random, 100.0);
    const Vec3 center = testing::randomPoint(random, 4.0);  // of both bodies, which turn as one
    EXPECT_LT(relativeLengthBound(body, Motion::about(pose_a, center, turn, way), body,
                                  Motion::about(pose_b, center, turn, way)),
              1e-10);
    const Motion still(pose_a, pose_a), moving = Motion::about(pose_b, center, turn, way);
    EXPECT_LE(relativeLengthBound(body, still, body, moving), moving.lengthBound(body));
  }
}

TEST(RelativeMotion, noSurfaceOfAConvexBodyGoesFartherThanTheBound) {
  std::mt19937_64 random(75);
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) points.push_back(Vec3(3, 0, 0) + testing::randomPoint(random, 1.0));
  const ConvexHull hull(points, 0.3), ball({Vec3(0.5, 0, 0)}, 2.0), rod({Vec3(-3, 0, 0), Vec3(3, 0, 0)}, 0.1);
  const Convex* const bodies[] = {&hull, &ball, &rod};
  int tight = 0;
  constexpr int kCases = 600;
  for (int i = 0; i < kCases; ++i) {
    const Convex& body = *bodies[i % 3];
    const BodyBounds bounds(body);
    const Motion motion =
        Motion::about(testing::randomPose(random, 4.0), testing::randomPoint(random, 5.0),
                      testing::randomPoint(random, i % 2 ? 3.0 : 0.0), testing::randomPoint(random, 3.0));
    const double bound = motion.lengthBound(bounds), start = testing::uniform(random, 0.0, 0.999);
    const Pose here = motion.at(start), next = motion.at(start + 1e-3);
    double step = 0.0;
    for (int k = 0; k < 200; ++k) {
      const Vec3 direction = testing::randomRotation(random).col(0);
      const Vec3 point = body.support(direction) + body.radius() * direction;
      step = std::max(step, (here * point - next * point).norm());
      ASSERT_LE((point - motion.centerInB()).norm(), bounds.distanceFromPoint(motion.centerInB()));
    }
    ASSERT_LE(step, 1e-3 * bound * (1.0 + 1e-9)) << i;
    ASSERT_LE(step, bounds.displacement(here, next) * (1.0 + 1e-9)) << i;
    tight += step > 0.6e-3 * bound;
  }
  EXPECT_GT(tight, kCases * 7 / 10);
}

TEST(Motion, aPartGoesWithTheBody) {
  std::mt19937_64 random(76);
  for (int i = 0; i < 100; ++i) {
    const Motion body = Motion::about(testing::randomPose(random, 4.0), testing::randomPoint(random, 5.0),
                                      testing::randomPoint(random, 3.0), testing::randomPoint(random, 3.0));
    const Pose part = testing::randomPose(random, 2.0);
    const Motion motion = body.ofPart(part);
    for (const double fraction : {0.0, 0.3, 1.0}) {
      const Pose expected = body.at(fraction) * part;
      ASSERT_TRUE(motion.at(fraction).rotation.isApprox(expected.rotation, 1e-13));
      ASSERT_LT((motion.at(fraction).translation - expected.translation).norm(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace octoblisk
