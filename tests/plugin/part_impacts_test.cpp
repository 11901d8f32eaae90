// When bodies of all kinds of parts meet ours within a step, against Bullet's own GJK for every triangle at
// many moments of the motion.
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <LinearMath/btTransformUtil.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "octoblisk/distance.h"
#include "octoblisk_bullet/time_of_impact.h"
#include "plugin/bullet_world.h"
#include "plugin/partners.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::Made;
using testing::Partner;
using testing::randomPoint;

constexpr double kDt = 1.0 / 60.0;
constexpr double kNear = 0.01;
constexpr double kMaxSlack = SweepOptions{}.slack;
/// By how much Bullet's GJK is off for bodies of about a unit.
constexpr double kOracleError = 1e-3;

btTransform integratedPose(const btRigidBody& body, double fraction) {
  btTransform moved;
  btTransformUtil::integrateTransform(body.getWorldTransform(), body.getLinearVelocity(),
                                      body.getAngularVelocity(), btScalar(fraction * kDt), moved);
  return moved;
}

/// The distance of a triangle and a convex shape; 0 where the cores meet. Bullet's search may end early,
/// never too near: so it is begun from several sides.
double distanceOf(const Triangle& triangle, const btConvexShape& convex, const btTransform& pose) {
  btTriangleShape shape(toBullet(triangle[0]), toBullet(triangle[1]), toBullet(triangle[2]));
  shape.setMargin(0);
  const Vec3 way = fromBullet(pose.getOrigin()) - centroidOf(triangle);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& guess : {way, Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
    btGjkEpaSolver2::sResults results;
    if (!btGjkEpaSolver2::Distance(&shape, btTransform::getIdentity(), &convex, pose, toBullet(guess),
                                   results))
      return 0.0;
    least = std::min(least, double(results.distance));
  }
  return std::max(0.0, least - double(convex.getMargin()));
}

/// The least distance of a mesh and a shape, both of which may be a part of a compound.
double distanceOf(const btCollisionShape& a, const Pose& a_in_world, const btCollisionShape& b,
                  const Pose& b_in_world) {
  if (a.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(a);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < compound.getNumChildShapes(); ++i) {
      const Pose child = a_in_world * fromBullet(compound.getChildTransform(i));
      least = std::min(least, distanceOf(*compound.getChildShape(i), child, b, b_in_world));
    }
    return least;
  }
  const auto* mesh = dynamic_cast<const ClusteredOctreeShape*>(&a);
  if (!mesh && b.isConvex()) return std::numeric_limits<double>::infinity();  // Bullet's own
  if (!mesh || b.isCompound()) return distanceOf(b, b_in_world, a, a_in_world);
  const Pose b_in_a = a_in_world.inverse() * b_in_world;
  if (const auto* other = dynamic_cast<const ClusteredOctreeShape*>(&b)) {
    return distance(mesh->tree(), other->tree(), b_in_a).distance;
  }
  const auto& convex = dynamic_cast<const btConvexShape&>(b);
  btVector3 center;
  btScalar radius;
  convex.getBoundingSphere(center, radius);
  const Vec3 middle = b_in_a * fromBullet(center);
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = 0; t < mesh->tree().mesh().triangleCount(); ++t) {
    const Triangle triangle = mesh->tree().mesh().triangle(t);
    double size = 0.0;
    for (const Vec3& corner : triangle) size = std::max(size, (corner - triangle[0]).norm());
    if ((triangle[0] - middle).norm() - size - double(radius) > least) continue;
    least = std::min(least, distanceOf(triangle, convex, toBullet(b_in_a)));
  }
  return least;
}

double distanceAt(const btRigidBody& a, const btRigidBody& b, double fraction) {
  return distanceOf(*a.getCollisionShape(), fromBullet(integratedPose(a, fraction)), *b.getCollisionShape(),
                    fromBullet(integratedPose(b, fraction)));
}

btRigidBody movable(btCollisionShape& shape) { return btRigidBody(1, nullptr, &shape, btVector3(1, 1, 1)); }

/// That the first time the two are as near as the tolerance is the impact, in either order of the bodies.
/// Returns whether there is one.
bool checkImpact(const btRigidBody& a, const btRigidBody& b) {
  const auto impact = timeOfImpact(a, b, btScalar(kDt), btScalar(kNear));
  constexpr int kSamples = 60;
  for (int sample = 0; sample <= kSamples; ++sample) {
    const double fraction = double(sample) / kSamples;
    if (impact && fraction >= double(impact->fraction)) break;
    EXPECT_GT(distanceAt(a, b, fraction), kNear - kOracleError) << "at " << fraction;
  }
  const auto reversed = timeOfImpact(b, a, btScalar(kDt), btScalar(kNear));
  EXPECT_EQ(impact.has_value(), reversed.has_value());
  if (!impact || !reversed) return false;
  const double here = distanceAt(a, b, double(impact->fraction));
  EXPECT_TRUE(impact->converged);
  EXPECT_LT(here, (1.0 + kMaxSlack) * kNear + kOracleError);
  EXPECT_GT(here, kNear - kOracleError);
  EXPECT_NEAR(here, impact->distance, kOracleError);
  EXPECT_NEAR((impact->point_on_a - impact->point_on_b).length(), impact->distance, kOracleError);
  EXPECT_EQ(impact->part_a, reversed->part_b);
  EXPECT_EQ(impact->part_b, reversed->part_a);
  if (impact->triangle_a.index >= 0 && impact->triangle_b.index >= 0) {
    EXPECT_NEAR(impact->fraction, reversed->fraction, 1e-4);
  } else {
    EXPECT_EQ(impact->fraction, reversed->fraction);
    EXPECT_EQ(impact->point_on_a, reversed->point_on_b);
    EXPECT_EQ(impact->point_on_b, reversed->point_on_a);
    EXPECT_EQ(impact->triangle_a.index, reversed->triangle_b.index);
    EXPECT_EQ(impact->triangle_b.index, reversed->triangle_a.index);
  }
  return true;
}

/// Puts both where they are apart and moves them, half of the time more or less at each other.
void throwAtEachOther(btRigidBody& a, btRigidBody& b, double spread, std::mt19937_64& random) {
  do {
    for (btRigidBody* body : {&a, &b}) {
      body->setWorldTransform(toBullet(testing::randomPose(random, spread)));
      body->setLinearVelocity(toBullet(randomPoint(random, 90.0)));
      body->setAngularVelocity(toBullet(randomPoint(random, 25.0)));  // at most 45° a step
    }
  } while (distanceAt(a, b, 0.0) < 2.0 * kNear);
  if (random() % 2 == 0) return;
  const btVector3 way = a.getWorldTransform().getOrigin() - b.getWorldTransform().getOrigin();
  b.setLinearVelocity(a.getLinearVelocity() + way * btScalar(testing::uniform(random, 0.3, 1.5) / kDt));
}

/// All but btBox2dShape: its core has a negative thickness, so what it gives is no support function.
std::vector<Partner> sweptPartners() {
  std::vector<Partner> partners = testing::convexPartners();
  std::erase_if(partners, [](const Partner& partner) { return partner.name == "box2d"; });
  return partners;
}

class PartImpacts : public ::testing::TestWithParam<Partner> {
 protected:
  ClusteredOctreeShape ring_ = shapeOver(testing::torus(1.4, 0.5, 12, 6));
};

TEST_P(PartImpacts, spinningBodies_vs_denseSampling) {
  const Made made = GetParam().make();
  btRigidBody mesh = movable(ring_), other = movable(*made.shape);
  std::mt19937_64 random(101);
  int hits = 0;
  constexpr int kCases = 50;
  for (int i = 0; i < kCases; ++i) {
    throwAtEachOther(mesh, other, 1.6, random);
    hits += checkImpact(mesh, other);
    if (HasFailure()) FAIL() << "case " << i;
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

INSTANTIATE_TEST_SUITE_P(Convex, PartImpacts, ::testing::ValuesIn(sweptPartners()),
                         [](const auto& partner) { return partner.param.name; });

/// Two rings that are linked, and a ball beside them, a part of it one compound deeper.
class LinkedRings : public ::testing::Test {
 protected:
  LinkedRings() {
    inner_.addChildShape(at(0.2, 0, 0), &ring_);
    inner_.addChildShape(at(-1.3, 0, 0), &ball_);
    rings_.addChildShape(at(-0.4, 0, 0), &ring_);
    rings_.addChildShape(btTransform(btQuaternion(btVector3(1, 0, 0), btScalar(1.3)), btVector3(0.3, 0, 0)),
                         &inner_);
  }

  ClusteredOctreeShape ring_ = shapeOver(testing::torus(0.6, 0.15, 12, 6)),
                       fan_ = shapeOver(testing::fan(5, 6));
  btSphereShape ball_{btScalar(0.3)};
  btCompoundShape inner_, rings_;
};

TEST_F(LinkedRings, spinningBodies_vs_denseSampling) {
  std::mt19937_64 random(102);
  btCapsuleShape capsule(btScalar(0.2), 1);
  btCollisionShape* const others[] = {&fan_, &capsule, &rings_};
  int hits = 0;
  constexpr int kCases = 90;
  for (int i = 0; i < kCases; ++i) {
    btRigidBody rings = movable(rings_), other = movable(*others[i % 3]);
    throwAtEachOther(rings, other, 1.3, random);
    hits += checkImpact(rings, other);
    if (HasFailure()) FAIL() << "case " << i;
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

TEST_F(LinkedRings, twoConvexPartsAreNotCompared) {
  btSphereShape shot_shape(btScalar(0.1));
  btCompoundShape ball_only, ring_and_ball;
  ball_only.addChildShape(at(0, 0, 0), &ball_);
  ring_and_ball.addChildShape(at(0, 0, 0), &ball_);
  ring_and_ball.addChildShape(at(2, 0, 0), &ring_);
  btRigidBody shot = movable(shot_shape), ball = movable(ball_only), both = movable(ring_and_ball);
  const auto impactAt = [&](double x) {
    shot.setWorldTransform(at(x, 0, 2));
    shot.setLinearVelocity(btVector3(0, 0, btScalar(-4.0 / kDt)));
    return timeOfImpact(both, shot, btScalar(kDt), btScalar(kNear));
  };
  EXPECT_FALSE(impactAt(0.0));  // through the ball
  const auto impact = impactAt(2.6);
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->part_a, &ring_);
  EXPECT_THROW(timeOfImpact(ball, shot, btScalar(kDt)), std::invalid_argument);
}

TEST(ConvexImpact, ballOntoAPlate_vs_closedForm) {
  ClusteredOctreeShape plate_shape = shapeOver(testing::boxMesh({2, 2, 0.001}));
  plate_shape.setMargin(btScalar(0.05));
  btSphereShape ball_shape(btScalar(0.25));
  btRigidBody plate = movable(plate_shape), ball = movable(ball_shape);
  plate.setWorldTransform(at(0, 0, -1));
  ball.setWorldTransform(at(0.3, 0.4, 3));
  plate.setLinearVelocity(btVector3(0, 0, 60));   // 1 up a step
  ball.setLinearVelocity(btVector3(0, 0, -540));  // 9 down
  const auto impact = timeOfImpact(ball, plate, btScalar(kDt), btScalar(kNear));
  ASSERT_TRUE(impact);
  const double gap = 4.0 - 0.25 - 0.001 - 0.05, reached = kNear + 0.05;
  EXPECT_LE(impact->fraction, (gap - kNear) / 10.0 + 1e-5);
  EXPECT_GE(impact->fraction, (gap - kNear - kMaxSlack * reached) / 10.0 - 1e-5);
  EXPECT_NEAR(impact->distance, gap - 10.0 * double(impact->fraction), 1e-5);
  EXPECT_NEAR(impact->point_on_a.z(), 3.0 - 0.25 - 9.0 * double(impact->fraction), 1e-5);
  EXPECT_NEAR(impact->point_on_b.z(), -0.999 + double(impact->fraction), 1e-5);
  EXPECT_EQ(impact->triangle_a.part, -1);
  EXPECT_EQ(impact->triangle_a.index, -1);
  EXPECT_GE(impact->triangle_b.index, 0);
  EXPECT_EQ(impact->part_a, &ball_shape);
  EXPECT_EQ(impact->part_b, &plate_shape);
}

TEST(ConvexImpact, oneThatTouchesAtTheStartMeetsThere) {
  ClusteredOctreeShape plate_shape = shapeOver(testing::boxMesh({2, 2, 0.001}));
  btCylinderShape cylinder(btVector3(1, 1, 1));
  btRigidBody plate = movable(plate_shape), body = movable(cylinder);
  body.setLinearVelocity(btVector3(0, 0, 60));
  const auto impact = timeOfImpact(plate, body, btScalar(kDt));
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, 0);
  EXPECT_LE(impact->distance, 0);
  EXPECT_TRUE(impact->converged);
}

}  // namespace
}  // namespace octoblisk
