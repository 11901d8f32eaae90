// Compares the time at which moving bodies meet within a step with Bullet's own integration, closed forms and
// dense sampling.
#include "octoblisk_bullet/time_of_impact.h"

#include <LinearMath/btTransformUtil.h>
#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "octoblisk/collide.h"
#include "octoblisk_bullet/step_motion.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::randomPoint;
using testing::uniform;

constexpr double kStep = 1.0 / 60.0;
constexpr double kTolerance = 0.01;
/// The error of results in Bullet's scalars for lengths of about 10.
constexpr double kError = 1e3 * double(SIMD_EPSILON);

btRigidBody bodyOf(ClusteredOctreeShape& shape) {
  return btRigidBody(1, nullptr, &shape, btVector3(1, 1, 1));
}

TEST(StepMotion, endsWhereBulletIntegratesTo) {
  std::mt19937_64 random(91);
  for (int i = 0; i < 2000; ++i) {
    const btTransform from = toBullet(testing::randomPose(random, 5.0));
    const btVector3 linear = toBullet(randomPoint(random, 300.0));
    // From no rotation to rotations that Bullet limits.
    const double fastest = std::pow(10.0, uniform(random, -6.0, 3.0));
    const btVector3 angular = toBullet(i % 20 ? randomPoint(random, fastest) : Vec3(Vec3::Zero()));
    btTransform expected, halfway;
    btTransformUtil::integrateTransform(from, linear, angular, btScalar(kStep), expected);
    btTransformUtil::integrateTransform(from, linear, angular, btScalar(kStep / 2), halfway);
    const Motion motion = stepMotion(from, linear, angular, btScalar(kStep));
    ASSERT_TRUE(motion.at(1.0).rotation.isApprox(fromBullet(expected.getBasis()), kError));
    ASSERT_LT((motion.at(1.0).translation - fromBullet(expected.getOrigin())).norm(), kError);
    if (double(angular.length()) * kStep > std::numbers::pi / 4.0) continue;
    ASSERT_TRUE(motion.at(0.5).rotation.isApprox(fromBullet(halfway.getBasis()), kError));
    ASSERT_LT((motion.at(0.5).translation - fromBullet(halfway.getOrigin())).norm(), kError);
  }
}

TEST(StepMotion, takesTheVelocitiesThatABodyHas) {
  ClusteredOctreeShape box = shapeOver(testing::boxMesh({1, 1, 1}));
  btRigidBody body = bodyOf(box);
  body.setLinearVelocity(btVector3(60, 0, 0));
  EXPECT_NEAR(stepMotion(body, btScalar(kStep)).advance().x(), 1.0, kError);
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  EXPECT_NEAR(stepMotion(body, btScalar(kStep)).advance().x(), 1.0, kError);
  body.setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
  EXPECT_EQ(stepMotion(body, btScalar(kStep)).advance().x(), 0.0);
  btCollisionObject object;  // static by default
  object.setCollisionFlags(0);
  object.setInterpolationAngularVelocity(btVector3(0, 0, 6));
  EXPECT_NEAR(stepMotion(object, btScalar(kStep)).angle(), 0.1, kError);
}

TEST(TimeOfImpact, twoBoxesHeadOn_vs_closedForm) {
  ClusteredOctreeShape box = shapeOver(testing::boxMesh({1, 1, 1}));
  btRigidBody a = bodyOf(box), b = bodyOf(box);
  a.setWorldTransform(at(-2, 0, 0));
  b.setWorldTransform(at(2, btScalar(0.5), 0));
  a.setLinearVelocity(btVector3(90, 0, 30));
  b.setLinearVelocity(btVector3(-90, 0, 30));  // 3 nearer per step, 2 apart
  auto impact = timeOfImpact(a, b, btScalar(kStep), btScalar(kTolerance));
  ASSERT_TRUE(impact);
  EXPECT_TRUE(impact->converged);
  EXPECT_NEAR(impact->fraction, (2.0 - kTolerance) / 3.0, kTolerance / 8.0 / 3.0 + kError);
  EXPECT_LE(impact->fraction, (2.0 - kTolerance) / 3.0 + kError);
  EXPECT_NEAR(impact->distance, 2.0 - 3.0 * double(impact->fraction), kError);
  EXPECT_NEAR(impact->point_on_a.x(), -1.0 + 1.5 * double(impact->fraction), kError);
  EXPECT_NEAR(impact->point_on_b.x(), 1.0 - 1.5 * double(impact->fraction), kError);
  EXPECT_NEAR(impact->point_on_a.z(), impact->point_on_b.z(), kError);
  // The default: a quarter of Bullet's breaking threshold of 0.02.
  impact = timeOfImpact(a, b, btScalar(kStep));
  ASSERT_TRUE(impact);
  EXPECT_NEAR(impact->distance, 0.005, 0.005 / 8.0 + kError);
  // With margins the bodies meet sooner.
  box.setMargin(btScalar(0.1));
  impact = timeOfImpact(a, b, btScalar(kStep), btScalar(kTolerance));
  ASSERT_TRUE(impact);
  EXPECT_NEAR(impact->fraction, (1.8 - kTolerance) / 3.0, kTolerance / 8.0 / 3.0 + kError);
  box.setMargin(0);
  b.setLinearVelocity(btVector3(90, 0, 30));
  EXPECT_FALSE(timeOfImpact(a, b, btScalar(kStep), btScalar(kTolerance)));
  b.setWorldTransform(at(-1, 0, 0));
  impact = timeOfImpact(a, b, btScalar(kStep), btScalar(kTolerance));
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, 0.0);
  EXPECT_LE(impact->distance, 0.0);
}

/// The slack is a fraction of the tolerance, however large the margins are.
TEST(TimeOfImpact, aBallThatPassesAboveABlock_vs_closedForm) {
  constexpr double kMargin = 0.3, kRadius = 0.5;
  ClusteredOctreeShape block = shapeOver(testing::boxMesh({10, 10, 10}));
  block.setMargin(btScalar(kMargin));
  btSphereShape ball(btScalar{kRadius});
  btRigidBody a = bodyOf(block), b(1, nullptr, &ball, btVector3(1, 1, 1));
  a.setWorldTransform(at(0, 0, 0));
  b.setLinearVelocity(btVector3(120, 0, 0));  // 2 per step
  for (const double gap : {0.5, 0.9, 1.2, 1.5, 3.0, 30.0}) {
    b.setWorldTransform(at(-1, 0, 10.0 + kMargin + kRadius + gap * kTolerance));
    const auto impact = timeOfImpact(a, b, btScalar(kStep), btScalar(kTolerance), {.max_steps = 100000});
    ASSERT_EQ(impact.has_value(), gap < 1.125) << gap;
    if (impact) {
      EXPECT_NEAR(impact->distance, gap * kTolerance, kError);
    }
  }
}

TEST(TimeOfImpact, spinningBodies_vs_denseSampling) {
  ClusteredOctreeShape fan = shapeOver(testing::fan(9, 10)),
                       ring = shapeOver(testing::torus(0.4, 0.1, 20, 12));
  btRigidBody a = bodyOf(fan), b = bodyOf(ring);
  std::mt19937_64 random(92);
  int hits = 0, cases = 0;
  constexpr int kCases = 100, kSamples = 200;
  while (cases < kCases) {
    for (btRigidBody* body : {&a, &b}) {
      body->setWorldTransform(toBullet(testing::randomPose(random, 1.1)));
      body->setLinearVelocity(toBullet(randomPoint(random, 120.0)));
      body->setAngularVelocity(toBullet(randomPoint(random, 25.0)));  // at most 45° a step
    }
    const auto bInA = [&](double fraction) {
      Pose pose[2];
      const btRigidBody* bodies[] = {&a, &b};
      for (int i = 0; i < 2; ++i) {
        btTransform moved;
        btTransformUtil::integrateTransform(bodies[i]->getWorldTransform(), bodies[i]->getLinearVelocity(),
                                            bodies[i]->getAngularVelocity(), btScalar(fraction * kStep),
                                            moved);
        pose[i] = fromBullet(moved);
      }
      return pose[0].inverse() * pose[1];
    };
    if (collide(fan.tree(), ring.tree(), bInA(0.0))) continue;
    ++cases;
    const auto impact = timeOfImpact(a, b, btScalar(kStep), btScalar(kTolerance));
    hits += impact.has_value();
    for (int sample = 0; sample <= kSamples; ++sample) {
      const double fraction = double(sample) / kSamples;
      if (impact && fraction >= double(impact->fraction)) break;
      ASSERT_FALSE(collide(fan.tree(), ring.tree(), bInA(fraction))) << cases << " at " << fraction;
    }
    if (!impact) continue;
    ASSERT_TRUE(impact->converged);
    ASSERT_LE(impact->distance, kTolerance * 1.13);
    const Clearance here = distance(fan.tree(), ring.tree(), bInA(double(impact->fraction)));
    ASSERT_NEAR(here.distance, impact->distance, kError);
    ASSERT_NEAR(double((impact->point_on_a - impact->point_on_b).length()), here.distance, kError);
    ASSERT_LT(impact->triangle_a.index, int(fan.tree().mesh().triangleCount()));
    ASSERT_LT(impact->triangle_b.index, int(ring.tree().mesh().triangleCount()));
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

TEST(TimeOfImpact, otherShapesAreRefused) {
  ClusteredOctreeShape box = shapeOver(testing::boxMesh({1, 1, 1}));
  btSphereShape sphere(1);
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btCompoundShape empty;
  btCollisionObject ours, convex, wall, nothing, shapeless;
  ours.setCollisionShape(&box);
  convex.setCollisionShape(&sphere);
  wall.setCollisionShape(&plane);
  nothing.setCollisionShape(&empty);
  for (const auto& [a, b] :
       {std::pair(&ours, &wall), std::pair(&ours, &nothing), std::pair(&ours, &shapeless),
        std::pair(&convex, &convex), std::pair(&convex, &wall)}) {
    EXPECT_THROW(timeOfImpact(*a, *b, btScalar(kStep)), std::invalid_argument);
    EXPECT_THROW(timeOfImpact(*b, *a, btScalar(kStep)), std::invalid_argument);
  }
}

}  // namespace
}  // namespace octoblisk
