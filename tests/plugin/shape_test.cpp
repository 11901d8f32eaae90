#include <gtest/gtest.h>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "plugin/bullet_world.h"
#include "plugin/collected_triangles.h"
#include "plugin/shape_over.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "shared/message_of.h"

namespace octoblisk {
namespace {

using testing::BulletMesh;

TEST(Shape, processAllTriangles_vs_bruteforce) {
  const auto mesh = testing::fan(7, 12);
  const ClusteredOctreeShape shape(treeOver(mesh));
  std::mt19937_64 random(31);
  std::size_t visited = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 center = testing::randomPoint(random, 2), half = testing::randomPoint(random, 0.5).cwiseAbs();
    CollectedTriangles found;
    shape.processAllTriangles(&found, toBullet(center - half), toBullet(center + half));
    ASSERT_EQ(static_cast<std::size_t>(found.calls), found.triangles.size());  // none twice
    const Vec3 low = fromBullet(toBullet(center - half)), high = fromBullet(toBullet(center + half));
    for (std::size_t t = 0; t < mesh->triangleCount(); ++t) {
      const bool bounds_overlap = boundsOf(mesh->triangle(t)).meets({low, high});
      const Obb box{0.5 * (low + high), Mat3::Identity(), 0.5 * (high - low)};
      const bool meets = testing::boxTriangleOverlap(box, mesh->triangle(t)) >= 0.0;
      const bool reported = found.triangles.contains({0, int(t)});
      ASSERT_TRUE(reported || !meets) << "box " << i << ", triangle " << t;
      ASSERT_TRUE(bounds_overlap || !reported) << "box " << i << ", triangle " << t;
    }
    visited += found.triangles.size();
  }
  EXPECT_GT(visited, 1000u);
}

TEST(Shape, processAllTrianglesTakesBoxesOfAnySize) {
  const auto mesh = testing::torus(3, 1, 16, 8);
  const ClusteredOctreeShape shape(treeOver(mesh));
  for (const btScalar size :
       {btScalar(BT_LARGE_FLOAT), SIMD_INFINITY, std::numeric_limits<btScalar>::infinity()}) {
    CollectedTriangles found;
    shape.processAllTriangles(&found, btVector3(-size, -size, -size), btVector3(size, size, size));
    EXPECT_EQ(found.triangles.size(), mesh->triangleCount()) << size;
  }
}

/// Reads the same two triangles through every layout that the interface allows.
template <typename Scalar, typename Index>
CollectedTriangles throughInterface(PHY_ScalarType vertex_type, PHY_ScalarType index_type) {
  struct Vertex {
    Scalar x, y, z;
    char padding[5];  // unaligned on purpose
  } __attribute__((packed));
  struct Corners {
    Index a, b, c;
    unsigned char padding[3];
  } __attribute__((packed));
  const Vertex vertices[4] = {{0, 0, 0, {}}, {1, 0, 0, {}}, {1, 1, 0, {}}, {0, 1, Scalar(0.5), {}}};
  const Corners triangles[2] = {{0, 1, 2, {}}, {0, 2, 3, {}}};
  btIndexedMesh part;
  part.m_numTriangles = 2;
  part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(triangles);
  part.m_triangleIndexStride = sizeof(Corners);
  part.m_numVertices = 4;
  part.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices);
  part.m_vertexStride = sizeof(Vertex);
  part.m_vertexType = vertex_type;
  btTriangleIndexVertexArray mesh;
  mesh.addIndexedMesh(part, index_type);
  mesh.addIndexedMesh(part, index_type);
  mesh.setScaling(btVector3(2, 3, 4));
  return trianglesOf(ClusteredOctreeShape(&mesh));
}

void expectBothParts(const CollectedTriangles& found) {
  ASSERT_EQ(found.triangles.size(), 4u);
  for (int part = 0; part < 2; ++part) {
    const auto& second = found.triangles.at({part, 1});
    EXPECT_EQ(second[0], Vec3(0, 0, 0));
    EXPECT_EQ(second[1], Vec3(2, 3, 0));
    EXPECT_EQ(second[2], Vec3(0, 3, 2));
  }
}

TEST(Shape, readsEveryIndexAndVertexTypeStrideAndPart) {
  expectBothParts(throughInterface<float, std::uint32_t>(PHY_FLOAT, PHY_INTEGER));
  expectBothParts(throughInterface<double, std::uint32_t>(PHY_DOUBLE, PHY_INTEGER));
  expectBothParts(throughInterface<float, std::uint16_t>(PHY_FLOAT, PHY_SHORT));
  expectBothParts(throughInterface<double, std::uint8_t>(PHY_DOUBLE, PHY_UCHAR));
}

TEST(Shape, sixteenBitIndicesAreUnsigned) {
  std::vector<float> vertices(3 * 40'000, 0.0f);
  vertices[3 * 39'999] = 7.0f;
  vertices[3 * 1 + 1] = 1.0f;
  const std::uint16_t corners[3] = {0, 1, 39'999};
  btIndexedMesh part;
  part.m_numTriangles = 1;
  part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(corners);
  part.m_triangleIndexStride = sizeof corners;
  part.m_numVertices = 40'000;
  part.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices.data());
  part.m_vertexStride = 3 * sizeof(float);
  part.m_vertexType = PHY_FLOAT;
  btTriangleIndexVertexArray mesh;
  mesh.addIndexedMesh(part, PHY_SHORT);
  EXPECT_EQ(trianglesOf(ClusteredOctreeShape(&mesh)).triangles.at({0, 0})[2], Vec3(7, 0, 0));
}

std::string messageOf(const btStridingMeshInterface* mesh) {
  return testing::messageOf([mesh] { const ClusteredOctreeShape shape(mesh); });
}

TEST(Shape, refusesBadMeshes) {
  EXPECT_EQ(messageOf(nullptr), "ClusteredOctreeShape: the mesh interface is null");
  btTriangleIndexVertexArray empty;
  EXPECT_EQ(messageOf(&empty), "the mesh has no triangles");

  int corners[3] = {0, 1, 5};
  btScalar vertices[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  btTriangleIndexVertexArray outside(1, corners, sizeof corners, 3, vertices, 3 * sizeof(btScalar));
  EXPECT_EQ(messageOf(&outside), "triangle 0 of part 0 uses vertex 5, but the part has 3 vertices");

  corners[2] = -1;
  EXPECT_EQ(messageOf(&outside), "triangle 0 of part 0 uses vertex -1, but the part has 3 vertices");

  corners[2] = 2;
  EXPECT_EQ(messageOf(&outside), "accepted");
  btTriangleIndexVertexArray of_one_vertex(1, corners, sizeof corners, 3, vertices, 0);
  EXPECT_EQ(messageOf(&of_one_vertex),
            "part 0 of the mesh interface has a stride of 0 between its 3 vertices");
  vertices[4] = std::numeric_limits<btScalar>::quiet_NaN();
  EXPECT_EQ(messageOf(&outside), "vertex 1 has the coordinate nan; it must be finite and at most 1e12");
  vertices[4] = 0;
  outside.getIndexedMeshArray()[0].m_indexType = PHY_FIXEDPOINT88;
  EXPECT_EQ(messageOf(&outside), "part 0 of the mesh interface has an unsupported index type");
  outside.getIndexedMeshArray()[0].m_indexType = PHY_INTEGER;
  outside.getIndexedMeshArray()[0].m_vertexBase = nullptr;
  EXPECT_EQ(messageOf(&outside), "part 0 of the mesh interface has a null pointer to its 3 vertices");
  outside.getIndexedMeshArray()[0].m_numVertices = -3;
  EXPECT_EQ(messageOf(&outside), "part 0 of the mesh interface has -3 vertices");
  EXPECT_THROW(ClusteredOctreeShape(std::shared_ptr<const ClusteredOctree>()), std::invalid_argument);
}

TEST(Shape, scalingKeepsTheBuildOptionsOfASharedTree) {
  BuildOptions options;
  options.leaf_capacity = 3;
  ClusteredOctreeShape shape(treeOver(testing::torus(2, 0.7, 24, 12), options));
  shape.setLocalScaling(btVector3(btScalar(1e-15), btScalar(1e-15), btScalar(1e-15)));
  EXPECT_EQ(shape.tree().options().leaf_capacity, 3);
}

TEST(Shape, scalingIsPerShapeAndKeepsTrianglesFacingOutward) {
  const auto mesh = testing::torus(3, 1, 16, 8);
  const auto tree = treeOver(mesh);
  ClusteredOctreeShape shape(tree), other(tree);
  shape.setLocalScaling(btVector3(-1, 2, btScalar(0.5)));
  EXPECT_EQ(&other.tree(), tree.get());
  double volume = 0.0;  // by the divergence theorem; positive if triangles face outward
  for (std::size_t t = 0; t < mesh->triangleCount(); ++t) {
    const Triangle corners = shape.tree().mesh().triangle(t);
    volume += corners[0].dot(corners[1].cross(corners[2])) / 6.0;
    EXPECT_EQ(corners[0], mesh->triangle(t)[0].cwiseProduct(Vec3(-1, 2, 0.5)));
  }
  EXPECT_GT(volume, 0.0);
  EXPECT_THROW(shape.setLocalScaling(btVector3(1, 0, 1)), std::invalid_argument);
  EXPECT_THROW(shape.setLocalScaling(btVector3(1, btScalar(NAN), 1)), std::invalid_argument);
  shape.setLocalScaling(btVector3(1, 1, 1));
  EXPECT_EQ(shape.tree().mesh().triangle(0), mesh->triangle(0));
}

TEST(Shape, aClosedMeshHasAMargin) {
  const auto marginOf = [](const testing::SharedMesh& mesh) {
    const ClusteredOctreeShape shape(treeOver(mesh));
    return double(shape.getMargin());
  };
  EXPECT_NEAR(marginOf(testing::boxMesh({0.3, 0.2, 0.1})), 0.003, 1e-7);
  EXPECT_NEAR(marginOf(testing::boxMesh({0.3, 0.2, 0.001})), 0.0002, 1e-7);
  EXPECT_NEAR(marginOf(testing::boxMesh({300, 200, 100})), 0.01, 1e-7);
  EXPECT_EQ(marginOf(testing::waveSheet(3, 1, 8)), 0);

  ClusteredOctreeShape shape(treeOver(testing::boxMesh({0.3, 0.2, 0.1})));
  shape.setLocalScaling(btVector3(2, 1, 1));
  EXPECT_NEAR(shape.getMargin(), 0.006, 1e-7);
  shape.setContactBreakingThreshold(btScalar(0.008));
  EXPECT_NEAR(shape.getMargin(), 0.004, 1e-7);
  shape.setLocalScaling(btVector3(1000, 1000, 1000));
  EXPECT_NEAR(shape.getMargin(), 0.004, 1e-7);
  shape.setContactBreakingThreshold(20);
  EXPECT_NEAR(shape.getMargin(), 3, 1e-4);
  shape.setMargin(0);
  shape.setLocalScaling(btVector3(1, 1, 1));
  EXPECT_EQ(shape.getMargin(), 0);
}

TEST(Shape, aabbHoldsTheTurnedMeshAndTheMargin) {
  const auto mesh = testing::torus(3, 1, 16, 8);
  ClusteredOctreeShape shape(treeOver(mesh));
  shape.setMargin(btScalar(0.25));
  std::mt19937_64 random(32);
  const btTransform pose = toBullet(testing::randomPose(random, 10));
  btVector3 low, high;
  shape.getAabb(pose, low, high);
  for (const Vec3& vertex : mesh->vertices()) {
    const btVector3 p = pose * toBullet(vertex);
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(low[k], p[k] - btScalar(0.2499));
      EXPECT_GE(high[k], p[k] + btScalar(0.2499));
    }
  }
}

TEST(Shape, breakingThresholdIsSmallAndSettable) {
  ClusteredOctreeShape large(treeOver(testing::torus(250, 20, 16, 8)));
  EXPECT_EQ(large.getContactBreakingThreshold(btScalar(0.02)), gContactBreakingThreshold);
  large.setContactBreakingThreshold(btScalar(0.5));
  EXPECT_EQ(large.getContactBreakingThreshold(btScalar(0.02)), btScalar(0.5));
}

// Contacts are created within half of the smaller threshold, whichever body comes first.
TEST(Shape, breakingThresholdOfAChildCountsInBothOrders) {
  ClusteredOctreeShape usual = shapeOver(testing::boxMesh({1, 1, 1})),
                       narrow = shapeOver(testing::boxMesh({1, 1, 1}));
  narrow.setContactBreakingThreshold(btScalar(0.001));
  btCompoundShape of_usual, of_narrow;
  of_usual.addChildShape(btTransform::getIdentity(), &usual);
  of_narrow.addChildShape(btTransform::getIdentity(), &narrow);
  for (const bool narrow_is_first : {true, false}) {
    for (const double gap : {0.0008, 0.0001}) {
      testing::BulletWorld world;
      world.add(narrow_is_first ? of_narrow : of_usual, 1, testing::at(0, 0, 0));
      world.add(narrow_is_first ? of_usual : of_narrow, 1, testing::at(0.1, 0.2, 2 + gap));
      world->performDiscreteCollisionDetection();
      EXPECT_EQ(world.contactPoints() > 0, gap < 0.0005) << narrow_is_first << ' ' << gap;
    }
  }
}

}  // namespace
}  // namespace octoblisk
