#include "octoblisk/half_space_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "shared/meshes.h"

namespace octoblisk {
namespace {

TEST(HalfSpaceContacts, corners_vs_bruteforce) {
  std::mt19937_64 random(43);
  for (const testing::SharedMesh& mesh :
       {testing::torus(3, 1, 32, 16), testing::fan(9, 10), testing::soup(random, 300, 5, 0.4)}) {
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    std::set<std::uint32_t> used;
    for (const TriangleMesh::Indices& corners : mesh->triangles())
      used.insert(corners.begin(), corners.end());
    std::vector<Contact> found;
    int hits = 0;
    constexpr int kPlanes = 200;
    for (int i = 0; i < kPlanes; ++i) {
      // Some planes are far beyond the mesh, on both sides.
      const HalfSpace plane{testing::randomRotation(random).col(0),
                            testing::uniform(random, -1, 1) * tree.mesh().bounds().halfExtents().norm() *
                                (i % 10 ? 1.8 : 1000.0)};
      const double threshold = i % 3 ? 0.1 : 0.0;
      contacts(tree, plane, threshold, found);
      std::vector<double> expected, distances;
      for (const std::uint32_t vertex : used) {
        const double height = plane.normal.dot(mesh->vertices()[vertex]) - plane.offset;
        if (height <= threshold) expected.push_back(height);
      }
      for (const Contact& contact : found) {
        distances.push_back(contact.distance);
        const Triangle triangle = mesh->triangle(contact.triangle_a);
        ASSERT_NE(std::ranges::find(triangle, contact.point_on_a), triangle.end());
        ASSERT_NEAR(plane.normal.dot(contact.point_on_b), plane.offset,
                    1e-12 * std::abs(plane.offset) + 1e-13);
        ASSERT_EQ(contact.normal, plane.normal);
        ASSERT_EQ(contact.triangle_b, kNoTriangle);
      }
      std::ranges::sort(expected);
      std::ranges::sort(distances);
      ASSERT_EQ(distances, expected) << "plane " << i;
      hits += !found.empty();
    }
    EXPECT_GE(hits, kPlanes * 3 / 10);
    EXPECT_LE(hits, kPlanes * 7 / 10);
  }
}

TEST(HalfSpaceContacts, aFlatMeshInThePlaneTouches) {
  const ClusteredOctree sheet = ClusteredOctree::build(testing::waveSheet(2, 0.0, 4));
  std::vector<Contact> found;
  contacts(sheet, HalfSpace{}, 0.0, found);
  EXPECT_EQ(found.size(), 25u);
  contacts(sheet, HalfSpace{Vec3::UnitZ(), -1e-9}, 0.0, found);
  EXPECT_TRUE(found.empty());
}

TEST(HalfSpaceContacts, aMeshFarBelowThePlaneIsInsideWithAllItsVertices) {
  std::mt19937_64 random(44);
  const ClusteredOctree tree = ClusteredOctree::build(testing::bumpySphere(random, 1.0, 0.3, 24));
  std::vector<Contact> found;
  for (const double offset : {1e3, 1e15, 1e16, 1e17, 1e30}) {
    for (int i = 0; i < 20; ++i) {
      contacts(tree, HalfSpace{testing::randomRotation(random).col(0), offset}, 0.0, found);
      ASSERT_EQ(found.size(), tree.mesh().vertices().size()) << offset;
    }
  }
  contacts(tree, HalfSpace{Vec3::UnitZ(), std::numeric_limits<double>::infinity()}, 0.0, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace octoblisk
