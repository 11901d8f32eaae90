#include "travelled_distances.h"

#include <gtest/gtest.h>

#include "octoblisk_bullet/convert.h"
#include "plugin/broadphase_worlds.h"
#include "shared/posed_vertices.h"

namespace octoblisk::detail {
namespace {

using testing::at;
using testing::TightWorld;

class TravelledDistancesTest : public ::testing::Test {
 protected:
  double travelled() {
    travelled_.beginStep();
    return travelled_.of(*body_->getBroadphaseHandle());
  }
  void moveTo(const btTransform& pose) {
    body_->setWorldTransform(pose);
    tight_.world.updateSingleAabb(body_);
  }

  const testing::SharedMesh mesh_ = testing::torus(2, 0.5, 24, 12);
  const std::unique_ptr<ClusteredOctreeShape> shape_ = testing::shapeOf(mesh_);
  btSphereShape sphere_{btScalar(0.5)};
  TightWorld tight_;
  btCollisionObject* body_ = &tight_.add(*shape_, at(1, 2, 3));
  TravelledDistances travelled_;
};

TEST_F(TravelledDistancesTest, aBodyThatStaysTravelsNothing) {
  for (btCollisionShape* const shape :
       {static_cast<btCollisionShape*>(shape_.get()), static_cast<btCollisionShape*>(&sphere_)}) {
    body_->setCollisionShape(shape);
    const double first = travelled();
    for (int i = 0; i < 5; ++i) EXPECT_EQ(travelled(), first);
  }
}

TEST_F(TravelledDistancesTest, aMeshTravelsAsItsVertices) {
  std::mt19937_64 random(41);
  double before = travelled();
  for (int i = 0; i < 200; ++i) {
    const Pose from = fromBullet(body_->getWorldTransform());
    const double angle = testing::uniform(random, 0, 0.5);
    btTransform pose(btQuaternion(toBullet(Vec3(testing::randomRotation(random).col(0))), btScalar(angle)));
    pose = pose * body_->getWorldTransform();
    pose.setOrigin(body_->getWorldTransform().getOrigin() +
                   btScalar(testing::uniform(random, 0, 1)) *
                       toBullet(Vec3(testing::randomRotation(random).col(0))));
    moveTo(pose);
    const Pose to = fromBullet(body_->getWorldTransform());
    const double longest = testing::greatestDisplacement(*mesh_, from, to);
    const double now = travelled();
    EXPECT_GE(now - before, longest * (1.0 - 1e-12));
    EXPECT_LE(now - before, 2.0 * longest);
    before = now;
  }
}

TEST_F(TravelledDistancesTest, aBoxTravelsAsItsCorners) {
  body_->setCollisionShape(&sphere_);
  moveTo(at(1, 2, 3));
  const double first = travelled();
  moveTo(at(1.25, 2, 3));
  EXPECT_GE(travelled() - first, 0.25);
  EXPECT_LE(travelled() - first, 0.25 * 1.8);
}

TEST_F(TravelledDistancesTest, aChangeCountsAsMoreThanTheBody) {
  double before = travelled();
  const auto expectLong = [&](const char* change) {
    const double now = travelled();
    EXPECT_GE(now - before, 2.5) << change;
    before = now;
  };
  shape_->setMargin(btScalar(0.1));
  expectLong("margin");
  shape_->setContactBreakingThreshold(btScalar(0.01));
  expectLong("threshold");
  shape_->setSolid(false);
  expectLong("solid");
  shape_->refit(mesh_);
  expectLong("refit");
  body_->setCollisionShape(&sphere_);
  expectLong("another shape");
  btCompoundShape compound;
  body_->setCollisionShape(&compound);
  EXPECT_EQ(travelled(), std::numeric_limits<double>::infinity());
  body_->setCollisionShape(shape_.get());
}

}  // namespace
}  // namespace octoblisk::detail
