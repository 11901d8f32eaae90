// Compares convex bodies at rest on the plugin's mesh with Bullet's own mesh and the closed form of a flat
// floor.
#include <gtest/gtest.h>

#include <cmath>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::BulletMesh;
using testing::BulletWorld;
using testing::NamedConvex;

const std::vector<NamedConvex> kBodies = {
    {"sphere", [] { return std::make_unique<btSphereShape>(btScalar(0.5)); }},
    {"box",
     [] { return std::make_unique<btBoxShape>(btVector3(btScalar(0.6), btScalar(0.5), btScalar(0.4))); }},
    {"capsule", [] { return std::make_unique<btCapsuleShape>(btScalar(0.3), btScalar(0.8)); }},
    {"cylinder",
     [] {
       return std::make_unique<btCylinderShape>(btVector3(btScalar(0.5), btScalar(0.4), btScalar(0.5)));
     }},
    {"cone", [] { return std::make_unique<btConeShape>(btScalar(0.5), btScalar(0.9)); }},
    {"hull", [] { return testing::roundHull(95, 24, 0.5); }},
};

/// The state of a body at the end of its fall, and of its contacts while it lay.
struct Rest {
  double lowest = 0.0;  ///< of its points: 0 is on the floor, below 0 is in it
  double speed = 0.0;
  double most_askew = 0.0;  ///< the sine of the widest angle between a contact's normal and the floor's
};

Rest restOn(btCollisionShape& floor, btConvexShape& shape, const btTransform& from) {
  BulletWorld world;
  world.add(floor, 0, btTransform::getIdentity());
  btRigidBody& body = world.add(shape, 1, from);
  body.setRollingFriction(btScalar(0.05));
  body.setDamping(btScalar(0.1), btScalar(0.3));
  Rest rest;
  for (int step = 0; step < 1440; ++step) {
    world.step(1);
    if (step < 1200) continue;
    for (const btManifoldPoint* point : testing::manifoldPoints(world.dispatcher())) {
      const Vec3 normal = fromBullet(point->m_normalWorldOnB);
      rest.most_askew = std::max(rest.most_askew, std::hypot(normal.x(), normal.y()));
    }
  }
  const btTransform& pose = body.getWorldTransform();
  const btVector3 down = btVector3(0, 0, -1) * pose.getBasis();
  rest.lowest = double((pose * shape.localGetSupportingVertex(down)).z());
  rest.speed = double(body.getLinearVelocity().length());
  return rest;
}

class Resting : public ::testing::TestWithParam<NamedConvex> {};

TEST_P(Resting, onAFlatFloorOfTriangles_vs_bvhAndClosedForm) {
  const testing::SharedMesh mesh = testing::waveSheet(20, 0.0, 60);
  ClusteredOctreeShape ours(treeOver(mesh));
  BulletMesh source(*mesh);
  btBvhTriangleMeshShape bvh(source.view(), true);
  bvh.setMargin(0);
  const std::unique_ptr<btConvexShape> shape = GetParam().make();
  std::mt19937_64 random(96);
  for (int i = 0; i < 3; ++i) {
    btTransform from = toBullet(testing::randomPose(random, 3.0));
    from.getOrigin().setZ(btScalar(1.2));
    const Rest on_ours = restOn(ours, *shape, from), on_bvh = restOn(bvh, *shape, from);
    EXPECT_LT(std::abs(on_ours.lowest), 0.005) << "fall " << i;
    EXPECT_LT(std::abs(on_ours.lowest), std::abs(on_bvh.lowest) + 0.002) << "fall " << i;
    EXPECT_LT(on_ours.speed, 0.02) << "fall " << i;
    EXPECT_LT(on_ours.most_askew, 0.002) << "fall " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, Resting, ::testing::ValuesIn(kBodies),
                         [](const auto& body) { return body.param.name; });

}  // namespace
}  // namespace octoblisk
