// Saves worlds to .bullet files and loads them again.
#include "octoblisk_bullet/world_importer.h"

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletWorldImporter/btMultiBodyWorldImporter.h>
#include <LinearMath/btSerializer.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "octoblisk_bullet/adopt_meshes.h"
#include "octoblisk_bullet/kinematic_body.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletMesh;
using testing::BulletWorld;

std::vector<char> saved(btDynamicsWorld& world, btDefaultSerializer& serializer) {
  world.serialize(&serializer);
  const auto* begin = reinterpret_cast<const char*>(serializer.getBufferPointer());
  return {begin, begin + serializer.getCurrentBufferSize()};
}

std::vector<char> saved(btDynamicsWorld& world) {
  btDefaultSerializer serializer;
  return saved(world, serializer);
}

template <typename Importer>
struct Loaded {
  explicit Loaded(std::vector<char> file) {
    EXPECT_TRUE(importer.loadFileFromMemory(file.data(), int(file.size())));
  }
  ~Loaded() { importer.deleteAllData(); }
  btRigidBody& body(int i) { return *btRigidBody::upcast(importer.getRigidBodyByIndex(i)); }

  BulletWorld world;
  Importer importer{&*world};
};

/// A tilt that avoids ties between contacts, which rounding would decide.
btTransform tilted(double x, double y, double z) {
  return at(x, y, z) * btTransform(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.3)));
}

/// A floor, and above it a ring, a scaled and mirrored ring, a gear in a compound at its principal axes, and
/// another gear in a compound with a box.
struct Scene {
  Scene() {
    ring.setMargin(btScalar(0.0625));
    ring.setContactBreakingThreshold(btScalar(0.03125));
    scaled.setLocalScaling(btVector3(btScalar(0.5), -1, btScalar(0.75)));
    btTransform principal;
    btVector3 moments;
    profile.calculatePrincipalAxisTransform(3, principal, moments);
    solid.addChildShape(principal.inverse(), &profile);
    mixed.addChildShape(at(0.25, 0, 0), &box);
    mixed.addChildShape(at(-0.5, 0, 0), &profile);
    world.add(floor, 0, at(0, 0, 0));
    world.add(ring, 2, tilted(-2, 0, 1));
    world.add(scaled, 1, tilted(2, 0, 1.5));
    btRigidBody& body = world.add(solid, 3, tilted(0, 2, 1));
    body.setMassProps(3, moments);
    world.add(mixed, 1, tilted(0, -2, 1)).setAngularVelocity(btVector3(0, 1, 2));
    world.add(ring, 1, tilted(-2, 0.25, 2)).setDamping(btScalar(0.125), btScalar(0.25));
    world.add(box, 1, tilted(0, 0, 1));
  }

  ClusteredOctreeShape floor = shapeOver(testing::waveSheet(6, 0.1, 24));
  ClusteredOctreeShape ring = shapeOver(testing::torus(0.75, 0.25, 24, 12));
  ClusteredOctreeShape scaled = shapeOver(testing::torus(0.75, 0.25, 24, 12));
  ClusteredOctreeShape profile = shapeOver(testing::gear(8, 0.5, 0.7, 0.2, 0.25));
  btBoxShape box{btVector3(btScalar(0.25), btScalar(0.25), btScalar(0.25))};
  btCompoundShape solid, mixed;
  BulletWorld world;
};

btRigidBody& bodyOf(BulletWorld& world, int i) {
  return *btRigidBody::upcast(world->getCollisionObjectArray()[i]);
}

const ClusteredOctreeShape* ours(const btCollisionShape* shape) {
  return dynamic_cast<const ClusteredOctreeShape*>(shape);
}

/// Both bodies are loaded with one shared compound.
TEST(WorldImporter, aCompoundThatBodiesShare) {
  ClusteredOctreeShape gear = shapeOver(testing::gear(8, 0.5, 0.7, 0.2, 0.25));
  gear.setSolid(false);
  btCompoundShape compound;
  compound.addChildShape(at(0, 0, 0), &gear);
  BulletWorld world;
  for (const double x : {0.0, 3.0}) world.add(compound, 1, at(x, 0, 1));
  Loaded<WorldImporter> loaded(saved(*world));
  for (int i = 0; i < 2; ++i) {
    const auto& read = dynamic_cast<const btCompoundShape&>(*loaded.body(i).getCollisionShape());
    const auto* child = dynamic_cast<const ClusteredOctreeShape*>(read.getChildShape(0));
    ASSERT_TRUE(child);
    EXPECT_FALSE(child->isSolid());
    EXPECT_EQ(child->getMargin(), 0);
  }
}

TEST(WorldImporter, stockLosesMassesAndShapes) {
  Scene scene;
  Loaded<btBulletWorldImporter> stock(saved(*scene.world));
  EXPECT_EQ(stock.body(1).getInvMass(), btScalar(0));
  EXPECT_EQ(ours(stock.body(1).getCollisionShape()), nullptr);
  EXPECT_EQ(stock.body(1).getCollisionShape()->getMargin(), scene.ring.getMargin());
  EXPECT_EQ(stock.body(4).getAngularVelocity().length(), btScalar(0));
}

/// Its bodies cannot move until they are given masses.
TEST(AdoptMeshes, aWorldOfTheStockImporter) {
  Scene scene;
  Loaded<btBulletWorldImporter> stock(saved(*scene.world));
  const auto massOf = [&](const btRigidBody& body) {
    const int i = stock.world->getCollisionObjectArray().findLinearSearch(const_cast<btRigidBody*>(&body));
    return btScalar(i == 0 ? 0 : 1);  // all but the floor
  };
  AdoptedMeshes adopted = adoptMeshes(*stock.world, massOf);
  EXPECT_TRUE(adopted.left().empty());
  EXPECT_EQ(adopted.replaced().size(), 5u);  // the importer makes the gear once for each compound
  int moving = 0;
  for (int i = 0; i < stock.importer.getNumRigidBodies(); ++i) moving += !stock.body(i).isStaticObject();
  EXPECT_EQ(moving, 6);
  stock.world.step(240);
  for (int i = 1; i < stock.importer.getNumRigidBodies(); ++i) {
    const double height = double(stock.body(i).getWorldTransform().getOrigin().z());
    EXPECT_GT(height, 0.0) << i;
    EXPECT_LT(height, 0.9) << i;
  }
  adopted.putBack();
  EXPECT_TRUE(dynamic_cast<btBvhTriangleMeshShape*>(stock.body(0).getCollisionShape()));
}

TEST(AdoptMeshes, aWorldOfTheMultibodyImporter) {
  Scene scene;
  std::vector<char> file = saved(*scene.world);
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btMultiBodyWorldImporter importer(&world);
  ASSERT_TRUE(importer.loadFileFromMemory(file.data(), int(file.size())));
  AdoptedMeshes adopted = adoptMeshes(world);
  EXPECT_EQ(adopted.replaced().size(), 5u);
  adopted.putBack();
  importer.deleteAllData();
}

TEST(WorldImporter, shapesAndMassesComeBack) {
  Scene scene;
  Loaded<WorldImporter> loaded(saved(*scene.world));
  ASSERT_EQ(loaded.importer.getNumRigidBodies(), scene.world->getNumCollisionObjects());
  for (int i = 0; i < loaded.importer.getNumRigidBodies(); ++i) {
    const btRigidBody &was = bodyOf(scene.world, i), &is = loaded.body(i);
    const double noise = 1e-6;
    EXPECT_NEAR(double(is.getInvMass()), double(was.getInvMass()), noise) << i;
    EXPECT_LT((is.getInvInertiaDiagLocal() - was.getInvInertiaDiagLocal()).length(), noise * 20) << i;
    EXPECT_EQ(is.isStaticObject(), was.isStaticObject()) << i;
    EXPECT_EQ(is.getActivationState(), was.getActivationState()) << i;
    EXPECT_EQ(is.getLinearDamping(), was.getLinearDamping()) << i;
    EXPECT_EQ(is.getBroadphaseHandle()->m_collisionFilterGroup,
              was.getBroadphaseHandle()->m_collisionFilterGroup);
    EXPECT_EQ(is.getCollisionShape()->getMargin(), was.getCollisionShape()->getMargin()) << i;
    const auto *shape = ours(is.getCollisionShape()), *expected = ours(was.getCollisionShape());
    ASSERT_EQ(shape != nullptr, expected != nullptr) << i;
    if (!shape) continue;
    EXPECT_EQ(shape->getLocalScaling(), expected->getLocalScaling()) << i;
    EXPECT_EQ(shape->getContactBreakingThreshold(btScalar(0.02)),
              expected->getContactBreakingThreshold(btScalar(0.02)));
    ASSERT_EQ(shape->tree().mesh().triangleCount(), expected->tree().mesh().triangleCount());
    for (std::uint32_t t = 0; t < shape->tree().mesh().triangleCount(); ++t)
      ASSERT_EQ(shape->tree().mesh().triangle(t), expected->tree().mesh().triangle(t));
  }
  EXPECT_EQ(loaded.body(1).getCollisionShape(), loaded.body(5).getCollisionShape());  // shared, as it was
  for (const int i : {3, 4}) {
    const auto& is = static_cast<const btCompoundShape&>(*loaded.body(i).getCollisionShape());
    const auto& was = static_cast<const btCompoundShape&>(*bodyOf(scene.world, i).getCollisionShape());
    ASSERT_EQ(is.getNumChildShapes(), was.getNumChildShapes());
    for (int c = 0; c < was.getNumChildShapes(); ++c)
      EXPECT_EQ(is.getChildShape(c)->getShapeType(), was.getChildShape(c)->getShapeType());
  }
}

/// A floating body, a tool that meets static bodies, and a body that meets nothing.
TEST(WorldImporter, gravityAndFiltersComeBack) {
  ClusteredOctreeShape ring = shapeOver(testing::torus(0.75, 0.25, 24, 12));
  BulletWorld world;
  world.add(ring, 0, at(0, 0, 0));
  world.add(ring, 1, at(5, 0, 0)).setGravity(btVector3(0, 0, 0));
  btRigidBody tool(0, nullptr, &ring);
  tool.setWorldTransform(at(0.5, 0, 0));
  addKinematicBody(*world, tool);
  btRigidBody apart(1, nullptr, &ring);
  world->addRigidBody(&apart, btBroadphaseProxy::DefaultFilter, 0);
  Loaded<WorldImporter> loaded(saved(*world));
  loaded.world.step(10);
  world->removeRigidBody(&tool);
  world->removeRigidBody(&apart);
  EXPECT_EQ(loaded.body(3).getBroadphaseHandle()->m_collisionFilterMask, 0);
  EXPECT_EQ(loaded.body(1).getLinearVelocity(), btVector3(0, 0, 0));
  EXPECT_EQ(loaded.body(1).getGravity(), btVector3(0, 0, 0));
  EXPECT_TRUE(loaded.body(2).isKinematicObject());
  EXPECT_GT(loaded.world.contactPoints(), 0);
}

TEST(WorldImporter, aLoadedWorldGoesOnAsTheSavedOne) {
  for (const int before : {0, 60, 110}) {  // new, falling, and touching (the solver then starts cold)
    const double near = before == 110 ? 0.03 : 0.002;
    const int steps = before == 110 ? 45 : 120;  // the difference grows as the rings roll
    Scene scene;
    scene.world.step(before);
    Loaded<WorldImporter> loaded(saved(*scene.world));
    for (int step = 0; step < steps; ++step) {
      scene.world.step(1);
      loaded.world.step(1);
      for (int i = 0; i < loaded.importer.getNumRigidBodies(); ++i) {
        const btTransform &was = bodyOf(scene.world, i).getWorldTransform(),
                          &is = loaded.body(i).getWorldTransform();
        ASSERT_LT(double((is.getOrigin() - was.getOrigin()).length()), near)
            << "step " << step << ", body " << i;
        ASSERT_LT(double(is.getRotation().angleShortestPath(was.getRotation())), 2 * near)
            << step << ", " << i;
      }
    }
    EXPECT_GT(loaded.world.contactPoints(), 3);
    EXPECT_LT(double(loaded.body(1).getWorldTransform().getOrigin().z()), 0.6);
  }
}

TEST(WorldImporter, whatOthersSavedStaysTheirs) {
  BulletMesh source(*testing::waveSheet(4, 0.1, 8));
  btBvhTriangleMeshShape bvh(source.view(), true);
  btSphereShape ball(btScalar(0.5));
  BulletWorld world;
  world.add(bvh, 0, at(0, 0, 0));
  world.add(ball, 1, at(0, 0, 1)).setLinearVelocity(btVector3(1, 0, 0));
  for (const int flags : {0, int(BT_SERIALIZE_NO_BVH)}) {
    btDefaultSerializer serializer;
    serializer.setSerializationFlags(flags);
    Loaded<WorldImporter> loaded(saved(*world, serializer));
    EXPECT_EQ(loaded.body(0).getCollisionShape()->getShapeType(), TRIANGLE_MESH_SHAPE_PROXYTYPE);
    EXPECT_EQ(loaded.body(1).getCollisionShape()->getShapeType(), SPHERE_SHAPE_PROXYTYPE);
    EXPECT_EQ(loaded.body(1).getLinearVelocity(), btVector3(1, 0, 0));
  }
}

TEST(WorldImporter, namesAndCollisionObjectsAreKept) {
  auto ring = shapeOver(testing::torus(0.75, 0.25, 24, 12));
  btCollisionObject object;
  object.setCollisionShape(&ring);
  object.setWorldTransform(at(1, 2, 3));
  BulletWorld world;
  world->addCollisionObject(&object);
  btRigidBody& body = world.add(ring, 1, at(0, 0, 5));
  btDefaultSerializer serializer;
  serializer.registerNameForPointer(&ring, "ring");
  serializer.registerNameForPointer(&body, "falling");
  Loaded<WorldImporter> loaded(saved(*world, serializer));
  world->removeCollisionObject(&object);
  btRigidBody* falling = loaded.importer.getRigidBodyByName("falling");
  ASSERT_NE(falling, nullptr);
  const btCollisionShape* shape = loaded.importer.getCollisionShapeByName("ring");
  ASSERT_NE(ours(shape), nullptr);
  EXPECT_EQ(falling->getCollisionShape(), shape);
  EXPECT_STREQ(loaded.importer.getNameForPointer(shape), "ring");
}

std::vector<char> contentOf(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// As Bullet's importer: a file that cannot be read is not written again.
TEST(WorldImporter, readsFilesByName) {
  const std::string start = ::testing::TempDir() + "octoblisk_" + std::to_string(std::random_device{}());
  const std::string name = start + "_saved.bullet", swapped = start + "_swapped.bullet";
  ClusteredOctreeShape shape = shapeOver(testing::torus(1, 0.4, 12, 8));
  BulletWorld world;
  world.add(shape, 1, at(0, 0, 0));
  const std::vector<char> content = saved(*world);
  std::ofstream(name, std::ios::binary).write(content.data(), std::streamsize(content.size()));
  std::ofstream(swapped) << "kept";
  BulletWorld other;
  WorldImporter importer(&*other);
  EXPECT_FALSE(importer.loadFile((start + "_missing.bullet").c_str(), swapped.c_str()));
  EXPECT_EQ(contentOf(swapped).size(), 4u);
  EXPECT_TRUE(importer.loadFile(name.c_str(), swapped.c_str()));
  EXPECT_EQ(contentOf(swapped).size(), content.size());
  ASSERT_EQ(importer.getNumRigidBodies(), 1);
  EXPECT_TRUE(dynamic_cast<ClusteredOctreeShape*>(importer.getRigidBodyByIndex(0)->getCollisionShape()));
  importer.deleteAllData();
  std::filesystem::remove(name);
  std::filesystem::remove(swapped);
}

/// The importer does not go on with a file whose shape threw.
TEST(WorldImporter, makesBodiesAfterAFileThatThrew) {
  constexpr float kMark = 1.234567f;
  const std::vector<Vec3> corners = {Vec3(0, 0, 0), Vec3(double(kMark), 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const std::vector<TriangleMesh::Indices> triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  ClusteredOctreeShape shape = shapeOver(std::make_shared<const TriangleMesh>(corners, triangles));
  BulletWorld world;
  world.add(shape, 1, at(0, 0, 0));
  std::vector<char> file = saved(*world);
  int marks = 0;
  const auto spoil = [&](auto number) {
    const auto mark = number;
    for (std::size_t i = 0; i + sizeof number <= file.size(); ++i) {
      std::memcpy(&number, &file[i], sizeof number);
      if (number != mark) continue;
      number = std::numeric_limits<decltype(number)>::quiet_NaN();
      std::memcpy(&file[i], &number, sizeof number);
      ++marks;
    }
  };
  spoil(kMark);
  spoil(double(kMark));
  ASSERT_GT(marks, 0);
  BulletWorld other;
  WorldImporter importer(&*other);
  EXPECT_ANY_THROW(importer.loadFileFromMemory(file.data(), int(file.size())));
  btSphereShape ball(1);
  EXPECT_TRUE(importer.createRigidBody(true, 1, at(0, 0, 0), &ball, "ball"));
  EXPECT_EQ(other->getNumCollisionObjects(), 1);
  importer.deleteAllData();
}

}  // namespace
}  // namespace octoblisk
