// The table of docs/bullet.md for other worlds: links of multibodies, and deformables, on concave bodies and
// as concave bodies.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>

#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "plugin/bullet_world.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletMesh;

/// One mesh as the three shapes of the table.
struct Shapes {
  explicit Shapes(const TriangleMesh& mesh)
      : source(mesh), ours(source.view()), bvh(source.view(), true), gimpact(source.view()) {
    gimpact.updateBound();
  }
  BulletMesh source;
  ClusteredOctreeShape ours;
  btBvhTriangleMeshShape bvh;
  btGImpactMeshShape gimpact;
};

/// Registers GImpact first, as both require.
void registerBoth(btCollisionDispatcher& dispatcher) {
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
  registerAlgorithm(&dispatcher);
}

/// Expects a final height at the floor, up to the margins, or far below it.
void expectHeight(double found, double on_floor, bool is_held, const std::string& what) {
  if (is_held) {
    EXPECT_NEAR(found, on_floor, 0.05) << what;
  } else {
    EXPECT_LT(found, on_floor - 0.4) << what;
  }
}

/// The final height of a link that falls onto a floor along a vertical slider of its multibody.
template <typename Broadphase>
double linkOn(btCollisionShape& link, btCollisionShape& floor, double floor_height) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  registerBoth(dispatcher);
  Broadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  btRigidBody ground(0, nullptr, &floor);
  ground.setWorldTransform(at(0, 0, floor_height));
  world.addRigidBody(&ground);
  const btVector3 inertia(btScalar(0.1), btScalar(0.1), btScalar(0.1));
  btMultiBody body(1, 0, btVector3(0, 0, 0), true, false);
  body.setBasePos(btVector3(0, 0, 3));
  body.setupPrismatic(0, 1, inertia, -1, btQuaternion::getIdentity(), btVector3(0, 0, -1), btVector3(0, 0, 0),
                      btVector3(btScalar(0.05), btScalar(0.1), btScalar(-1)), true);
  body.finalizeMultiDof();
  btMultiBodyLinkCollider collider(&body, 0);
  collider.setCollisionShape(&link);
  collider.setWorldTransform(at(0.05, 0.1, 2));
  body.getLink(0).m_collider = &collider;
  world.addMultiBody(&body);
  world.addCollisionObject(&collider, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
  for (int i = 0; i < 360; ++i) world.stepSimulation(btScalar(1.0 / 240.0), 0);
  const double height = double(collider.getWorldTransform().getOrigin().z());
  world.removeCollisionObject(&collider);
  world.removeMultiBody(&body);
  world.removeRigidBody(&ground);
  return height;
}

/// Tests a link on a floor, with both broadphases.
void expectLink(btCollisionShape& link, btCollisionShape& floor, bool is_held, double floor_height = 0) {
  const std::string what = std::string(link.getName()) + " on " + floor.getName();
  expectHeight(linkOn<btDbvtBroadphase>(link, floor, floor_height), 0.25, is_held, what);
  expectHeight(linkOn<ClusteredOctreeBroadphase>(link, floor, floor_height), 0.25, is_held, what);
}

struct Floors : Shapes {
  Floors() : Shapes(*testing::waveSheet(4, 0.0, 16)) {}
  btStaticPlaneShape plane{btVector3(0, 0, 1), 0};
  btBoxShape slab{btVector3(4, 4, btScalar(0.5))};
};

TEST(StockWorlds, convexLinksRestOnAll) {
  Floors floors;
  btBoxShape box(toBullet(Vec3(0.4, 0.3, 0.25)));
  btSphereShape ball(btScalar(0.25));
  btCapsuleShapeX capsule(btScalar(0.25), 1);
  for (btCollisionShape* link : std::initializer_list<btCollisionShape*>{&box, &ball, &capsule}) {
    expectLink(*link, floors.ours, true);
    expectLink(*link, floors.bvh, true);
    expectLink(*link, floors.gimpact, true);
  }
}

TEST(StockWorlds, concaveLinksMeetWhatRigidBodiesMeet) {
  Floors floors;
  Shapes rings(*testing::torus(0.6, 0.25, 24, 12));
  for (btCollisionShape* link : std::initializer_list<btCollisionShape*>{&rings.ours, &rings.gimpact}) {
    expectLink(*link, floors.ours, true);
    expectLink(*link, floors.bvh, true);
    expectLink(*link, floors.gimpact, true);
    expectLink(*link, floors.plane, true);
    expectLink(*link, floors.slab, true, -0.5);
  }
  expectLink(rings.bvh, floors.ours, true);
  expectLink(rings.bvh, floors.bvh, false);
  expectLink(rings.bvh, floors.gimpact, true);
  expectLink(rings.bvh, floors.plane, false);
  expectLink(rings.bvh, floors.slab, true, -0.5);
}

/// A deformable, and its features that Bullet tests against rigid bodies.
struct Soft {
  const char* name;
  bool is_ball;
  int tested;

  bool isTestedByFaces() const { return tested == btSoftBody::fCollision::SDF_RDF; }
  friend void PrintTo(const Soft& soft, std::ostream* out) { *out << soft.name; }
};

/// Makes the deformable with its lowest nodes at the height.
btSoftBody* made(const Soft& kind, btSoftBodyWorldInfo& info, double height) {
  if (kind.is_ball) {
    return btSoftBodyHelpers::CreateEllipsoid(info, toBullet(Vec3(0, 0, height + 0.3)),
                                              toBullet(Vec3(0.3, 0.3, 0.3)), 64);
  }
  const auto corner = [&](double x, double y) { return toBullet(Vec3(0.6 * x, 0.6 * y, height)); };
  return btSoftBodyHelpers::CreatePatch(info, corner(-1, -1), corner(1, -1), corner(-1, 1), corner(1, 1), 9,
                                        9, 0, true);
}

/// The height of the lowest node of a deformable that fell on a body. The body's top ends at 0. The body is
/// static, or it falls and comes to rest on a floor 0.5 lower.
template <typename Broadphase>
double lowestOn(const Soft& kind, btCollisionShape& shape, bool is_static) {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  registerBoth(dispatcher);
  Broadphase broadphase;
  btDeformableBodySolver soft_solver;
  btDeformableMultiBodyConstraintSolver solver;
  solver.setDeformableSolver(&soft_solver);
  btDeformableMultiBodyDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration, &soft_solver);
  const btVector3 gravity(0, 0, btScalar(-9.81));
  world.setGravity(gravity);
  world.getWorldInfo().m_gravity = gravity;
  world.getWorldInfo().m_sparsesdf.setDefaultVoxelsz(btScalar(0.25));
  world.getWorldInfo().m_sparsesdf.Reset();
  btBoxShape slab(toBullet(Vec3(4, 4, 0.5)));
  btRigidBody ground(0, nullptr, &slab);
  ground.setWorldTransform(at(0, 0, is_static ? -20 : -1));
  world.addRigidBody(&ground);
  btRigidBody body(btScalar(is_static ? 0 : 10), nullptr, &shape, btVector3(3, 3, 6));
  body.setWorldTransform(at(0, 0, is_static ? 0 : 0.25));
  body.setInterpolationWorldTransform(body.getWorldTransform());
  body.setActivationState(DISABLE_DEACTIVATION);
  world.addRigidBody(&body);
  btSoftBody* soft = made(kind, world.getWorldInfo(), is_static ? 0.3 : 0.7);
  soft->getCollisionShape()->setMargin(btScalar(0.02));
  soft->generateBendingConstraints(2);
  soft->setTotalMass(1);
  soft->m_cfg.kDF = 1;
  soft->m_cfg.kKHR = 1;
  soft->m_cfg.kCHR = 1;
  soft->m_cfg.collisions = btSoftBody::fCollision::SDF_RD | kind.tested;
  soft->setSelfCollision(false);
  world.addSoftBody(soft);
  btDeformableMassSpringForce springs(10, 1, true);
  btDeformableGravityForce weight(gravity);
  world.addForce(soft, &springs);
  world.addForce(soft, &weight);
  for (int i = 0; i < 240; ++i) world.stepSimulation(btScalar(1.0 / 240.0), 0);
  double lowest = 1e9;
  for (int n = 0; n < soft->m_nodes.size(); ++n) lowest = std::min(lowest, double(soft->m_nodes[n].m_x.z()));
  world.removeForce(soft, &springs);
  world.removeForce(soft, &weight);
  world.removeSoftBody(soft);
  delete soft;
  world.removeRigidBody(&body);
  world.removeRigidBody(&ground);
  return lowest;
}

class StockDeformables : public ::testing::TestWithParam<Soft> {
 protected:
  /// Expects a deformable held by its nodes to lie at the margin, and by its faces within a few margins.
  void expectHeld(btCollisionShape& shape, bool is_static, bool is_held) {
    const std::string what = std::string(shape.getName()) + (is_static ? ", static" : ", moving");
    expectHeight(lowestOn<btDbvtBroadphase>(GetParam(), shape, is_static), 0.06, is_held, what);
    expectHeight(lowestOn<ClusteredOctreeBroadphase>(GetParam(), shape, is_static), 0.06, is_held, what);
  }
};

TEST_P(StockDeformables, onStaticBodies) {
  Floors floors;
  expectHeld(floors.ours, true, true);
  expectHeld(floors.bvh, true, true);
  expectHeld(floors.gimpact, true, GetParam().isTestedByFaces());
}

TEST_P(StockDeformables, onMovingBodies) {
  Shapes plates(*testing::boxMesh({1, 1, 0.25}));
  expectHeld(plates.ours, false, true);
  expectHeld(plates.bvh, false, true);
  expectHeld(plates.gimpact, false, GetParam().isTestedByFaces());
}

INSTANTIATE_TEST_SUITE_P(PairMatrix, StockDeformables,
                         ::testing::Values(Soft{"clothByNodes", false, btSoftBody::fCollision::SDF_RDN},
                                           Soft{"clothByFaces", false, btSoftBody::fCollision::SDF_RDF},
                                           Soft{"ballByNodes", true, btSoftBody::fCollision::SDF_RDN},
                                           Soft{"ballByFaces", true, btSoftBody::fCollision::SDF_RDF}),
                         [](const auto& soft) { return std::string(soft.param.name); });

}  // namespace
}  // namespace octoblisk
