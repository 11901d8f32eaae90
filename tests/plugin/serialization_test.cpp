// Writes the shape as Bullet writes meshes and reads it back with Bullet's own importer. Also keeps its tree
// as a blob.
#include <BulletCollision/CollisionDispatch/btCollisionWorldImporter.h>
#include <LinearMath/btSerializer.h>
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "octoblisk/tree_blob.h"
#include "octoblisk_bullet/mesh_interface.h"
#include "octoblisk_bullet/restore.h"
#include "plugin/bullet_world.h"
#include "plugin/collected_triangles.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::BulletMesh;

/// Leaves pointers unchanged, because the importer reads the chunks in place.
struct InMemorySerializer final : btDefaultSerializer {
  ~InMemorySerializer() override { btDefaultSerializer::finishSerialization(); }  // frees the chunks
  void* getUniquePointer(void* pointer) override { return pointer; }
};

struct Importer final : btCollisionWorldImporter {
  Importer() : btCollisionWorldImporter(nullptr) {}
  ~Importer() override { deleteAllData(); }
  btCollisionShape* shapeOf(void* data) {
    return convertCollisionShape(static_cast<btCollisionShapeData*>(data));
  }
};

/// A torus and a sheet as two parts of one interface, scaled.
struct TwoParts {
  BulletMesh torus{*testing::torus(2, 0.7, 12, 6)}, sheet{*testing::waveSheet(2, 0.3, 5)};
  btTriangleIndexVertexArray interface;

  TwoParts() {
    interface.addIndexedMesh(torus.view()->getIndexedMeshArray()[0]);
    interface.addIndexedMesh(sheet.view()->getIndexedMeshArray()[0]);
    interface.setScaling(btVector3(2, btScalar(0.5), 1));
  }
};

TEST(Serialization, aStockImporterLoadsTheSameTriangles) {
  TwoParts source;
  ClusteredOctreeShape shape(&source.interface);
  shape.setMargin(btScalar(0.125));
  InMemorySerializer serializer;
  serializer.startSerialization();
  std::vector<btVector3DoubleData> aligned(  // room for the data, aligned
      std::size_t(shape.calculateSerializeBufferSize()) / sizeof(btVector3DoubleData) + 1);
  EXPECT_STREQ(shape.serialize(aligned.data(), &serializer), "btTriangleMeshShapeData");
  Importer importer;
  const auto* loaded = dynamic_cast<btBvhTriangleMeshShape*>(importer.shapeOf(aligned.data()));
  ASSERT_NE(loaded, nullptr);
  EXPECT_EQ(loaded->getMargin(), btScalar(0.125));
  EXPECT_EQ(loaded->getMeshInterface()->getNumSubParts(), 2);
  const auto expected = trianglesOf(shape).triangles, found = trianglesOf(*loaded).triangles;
  ASSERT_EQ(expected.size(), 12u * 6u * 2u + 5u * 5u * 2u);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [id, triangle] : expected) {
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LT((found.at(id)[k] - triangle[k]).norm(), 1e-6) << "part " << id.first << ", " << id.second;
    }
  }
  // The shape made from the read mesh has the same mesh to the last bit.
  const ClusteredOctreeShape again(loaded->getMeshInterface());
  EXPECT_EQ(again.getLocalScaling(), shape.getLocalScaling());
  for (std::uint32_t t = 0; t < shape.tree().mesh().triangleCount(); ++t) {
    ASSERT_EQ(again.tree().mesh().triangle(t), shape.tree().mesh().triangle(t));
    ASSERT_EQ(again.triangleId(t).part, shape.triangleId(t).part);
  }
}

/// The data that a shape writes, aligned.
std::vector<btVector3DoubleData> dataOf(const btCollisionShape& shape, btSerializer& serializer) {
  std::vector<btVector3DoubleData> data(
      std::size_t(shape.calculateSerializeBufferSize()) / sizeof(btVector3DoubleData) + 1);
  shape.serialize(data.data(), &serializer);
  return data;
}

TEST(Serialization, theShapeIsRestored) {
  TwoParts source;
  for (const btScalar threshold : {btScalar(-1), btScalar(0), btScalar(0.25)}) {
    ClusteredOctreeShape shape(&source.interface);
    shape.setMargin(btScalar(0.125));
    if (threshold >= 0) shape.setContactBreakingThreshold(threshold);
    InMemorySerializer serializer;
    serializer.startSerialization();
    auto data = dataOf(shape, serializer);
    Importer importer;
    const auto& read = dynamic_cast<btBvhTriangleMeshShape&>(*importer.shapeOf(data.data()));
    const auto& saved = *reinterpret_cast<const btCollisionShapeData*>(data.data());
    const auto restored = restoredShape(saved, *read.getMeshInterface());
    ASSERT_NE(restored, nullptr);
    EXPECT_EQ(restored->getMargin(), shape.getMargin());
    EXPECT_EQ(restored->getLocalScaling(), shape.getLocalScaling());
    EXPECT_EQ(restored->getContactBreakingThreshold(btScalar(0.001)),
              shape.getContactBreakingThreshold(btScalar(0.001)));
    EXPECT_EQ(trianglesOf(*restored).triangles, trianglesOf(shape).triangles);
    EXPECT_EQ(restored->parts(), shape.parts());
  }
}

TEST(Serialization, whatOthersWroteIsNotRestored) {
  TwoParts source;
  btBvhTriangleMeshShape bvh(&source.interface, true);
  btSphereShape ball(1);
  for (const btCollisionShape* shape :
       {static_cast<btCollisionShape*>(&bvh), static_cast<btCollisionShape*>(&ball)}) {
    InMemorySerializer serializer;
    serializer.startSerialization();
    const auto data = dataOf(*shape, serializer);
    EXPECT_EQ(restoredShape(*reinterpret_cast<const btCollisionShapeData*>(data.data()), source.interface),
              nullptr);
  }
}

TEST(Serialization, aBodyIsRestored) {
  ClusteredOctreeShape shape(treeOver(testing::torus(2, 0.7, 12, 6)));
  btRigidBody body(4, nullptr, &shape, btVector3(1, 2, 0)), other(0, nullptr, &shape);
  body.setLinearVelocity(btVector3(1, 2, 3));
  body.setAngularVelocity(btVector3(4, 5, 6));
  body.setDamping(btScalar(0.25), btScalar(0.5));
  body.setSleepingThresholds(btScalar(0.125), btScalar(0.75));
  body.setLinearFactor(btVector3(1, 0, 1));
  body.setFriction(btScalar(0.125));
  body.setRollingFriction(btScalar(0.25));
  body.setRestitution(btScalar(0.375));
  body.setCcdMotionThreshold(btScalar(0.0625));
  body.setCcdSweptSphereRadius(btScalar(0.03125));
  body.setContactStiffnessAndDamping(1000, 50);
  body.setAnisotropicFriction(btVector3(1, btScalar(0.5), 1));
  body.setContactProcessingThreshold(btScalar(0.25));
  body.forceActivationState(DISABLE_DEACTIVATION);
  InMemorySerializer serializer;
  serializer.startSerialization();
  btRigidBodyData data;
  body.serialize(&data, &serializer);
  restoreBody(data, other);
  EXPECT_EQ(other.getMass(), body.getMass());
  EXPECT_EQ(other.getLocalInertia(), body.getLocalInertia());
  EXPECT_EQ(other.getInvInertiaTensorWorld().getRow(1), body.getInvInertiaTensorWorld().getRow(1));
  EXPECT_FALSE(other.isStaticObject());
  EXPECT_EQ(other.getLinearVelocity(), body.getLinearVelocity());
  EXPECT_EQ(other.getAngularVelocity(), body.getAngularVelocity());
  EXPECT_EQ(other.getLinearDamping(), body.getLinearDamping());
  EXPECT_EQ(other.getAngularDamping(), body.getAngularDamping());
  EXPECT_EQ(other.getLinearSleepingThreshold(), body.getLinearSleepingThreshold());
  EXPECT_EQ(other.getAngularSleepingThreshold(), body.getAngularSleepingThreshold());
  EXPECT_EQ(other.getLinearFactor(), body.getLinearFactor());
  EXPECT_EQ(other.getFriction(), body.getFriction());
  EXPECT_EQ(other.getRollingFriction(), body.getRollingFriction());
  EXPECT_EQ(other.getRestitution(), body.getRestitution());
  EXPECT_EQ(other.getCcdMotionThreshold(), body.getCcdMotionThreshold());
  EXPECT_EQ(other.getCcdSweptSphereRadius(), body.getCcdSweptSphereRadius());
  EXPECT_TRUE((other.getCollisionFlags() & btCollisionObject::CF_HAS_CONTACT_STIFFNESS_DAMPING) != 0);
  EXPECT_EQ(other.getContactStiffness(), 1000);
  EXPECT_EQ(other.getContactDamping(), 50);
  EXPECT_TRUE(other.hasAnisotropicFriction());
  EXPECT_EQ(other.getAnisotropicFriction(), body.getAnisotropicFriction());
  EXPECT_EQ(other.getContactProcessingThreshold(), body.getContactProcessingThreshold());
  EXPECT_EQ(other.getActivationState(), DISABLE_DEACTIVATION);
}

TEST(Serialization, aWorldIsWrittenWithTheShape) {
  ClusteredOctreeShape shape(treeOver(testing::torus(2, 0.7, 12, 6)));
  testing::BulletWorld world;
  world.add(shape, 1, testing::at(1, 2, 3));
  struct Keeping final : btDefaultSerializer {
    void finishSerialization() override {}  // which frees the chunks
    ~Keeping() override { btDefaultSerializer::finishSerialization(); }
  } serializer;
  serializer.registerNameForPointer(&shape, "ring");
  world->serialize(&serializer);
  std::map<int, int> chunks;
  for (int i = 0; i < serializer.getNumChunks(); ++i) ++chunks[serializer.getChunk(i)->m_chunkCode];
  EXPECT_EQ(chunks[BT_SHAPE_CODE], 1);
  EXPECT_EQ(chunks[BT_RIGIDBODY_CODE], 1);
  EXPECT_GE(chunks[BT_ARRAY_CODE], 3);  // the part, its vertices, its indices
  for (int i = 0; i < serializer.getNumChunks(); ++i) {
    const btChunk* chunk = serializer.getChunk(i);
    if (chunk->m_chunkCode != BT_SHAPE_CODE) continue;
    EXPECT_EQ(chunk->m_length, int(sizeof(btTriangleMeshShapeData)));
    const auto* data = reinterpret_cast<const btTriangleMeshShapeData*>(chunk + 1);
    EXPECT_EQ(data->m_collisionShapeData.m_shapeType, TRIANGLE_MESH_SHAPE_PROXYTYPE);
    EXPECT_NE(data->m_collisionShapeData.m_name, nullptr);
    EXPECT_EQ(data->m_meshInterface.m_numMeshParts, 1);
  }
}

TEST(Serialization, aTreeGoesThroughABlobWithItsParts) {
  TwoParts source;
  source.interface.setScaling(btVector3(1, 1, 1));
  const ClusteredOctreeShape shape(&source.interface);
  const std::vector<std::byte> blob = toBlob(shape.tree());
  InterfaceMesh read = readMeshInterface(source.interface);
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(read.mesh));
  const ClusteredOctreeShape loaded(std::make_shared<const ClusteredOctree>(fromBlob(blob, mesh)),
                                    read.part_begin);
  EXPECT_EQ(trianglesOf(loaded).triangles, trianglesOf(shape).triangles);
  EXPECT_EQ(loaded.parts(), shape.parts());
  EXPECT_EQ(loaded.triangleId(144).part, 1);
  EXPECT_EQ(loaded.triangleId(144).index, 0);
}

}  // namespace
}  // namespace octoblisk
