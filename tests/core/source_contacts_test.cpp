#include "octoblisk/source_contacts.h"

#include <gtest/gtest.h>

#include <limits>

#include "shared/brute_force.h"
#include "shared/mesh_source.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

struct SourceScene {
  const char* name;
  testing::SharedMesh a, b;
  double spread;
  int poses;
};

std::vector<SourceScene> sourceScenes() {
  std::mt19937_64 random(41);
  return {
      {"linked tori", testing::torus(3, 1, 32, 16), testing::torus(3, 0.8, 32, 16), 5.5, 60},
      {"torus in a fan", testing::torus(0.5, 0.15, 20, 12), testing::fan(9, 10), 1.3, 100},
      {"soups", testing::soup(random, 300, 5, 0.4), testing::soup(random, 300, 5, 0.4), 9.5, 100},
      {"boxes", testing::boxMesh({1, 2, 3}), testing::boxMesh({2, 1, 1}), 4.4, 100},
      {"a box round a fine mesh", testing::boxMesh({1, 1, 1}), testing::torus(1.4, 0.3, 64, 32), 2.8, 60}};
}

TEST(SourceContacts, contacts_vs_bruteforce) {
  for (const SourceScene& scene : sourceScenes()) {
    const ClusteredOctree a = ClusteredOctree::build(scene.a);
    const testing::MeshSource b(*scene.b);
    SourceContacts query;
    std::vector<Contact> found;
    std::mt19937_64 random(42);
    int hits = 0;
    for (int i = 0; i < scene.poses; ++i) {
      const Pose pose = testing::randomPose(random, scene.spread);
      const double threshold = i % 3 ? 0.1 : 0.0;
      const std::vector<Contact> expected = testing::bruteForceContacts(*scene.a, *scene.b, pose, threshold);
      query.find(a, b, pose, threshold, found);
      ASSERT_EQ(found.size(), expected.size()) << scene.name << ", pose " << i;
      for (std::size_t c = 0; c < found.size(); ++c) {
        ASSERT_EQ(found[c].triangle_a, expected[c].triangle_a);
        const SourceTriangle& triangle = query.triangle(found[c].triangle_b);
        ASSERT_EQ(triangle.index, static_cast<int>(expected[c].triangle_b));
        ASSERT_EQ(triangle.corners, scene.b->triangle(expected[c].triangle_b));
        ASSERT_EQ(found[c].distance, expected[c].distance);
        ASSERT_EQ(found[c].point_on_b, expected[c].point_on_b);
      }
      hits += !found.empty();
    }
    EXPECT_GE(hits, scene.poses * 3 / 10) << scene.name;
    EXPECT_LE(hits, scene.poses * 7 / 10) << scene.name;
  }
}

TEST(SourceContacts, aSmallMeshOnALargeOneAsksOnce) {
  const testing::SharedMesh floor = testing::waveSheet(20, 0.1, 100);
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(1, 0.3, 32, 16));
  const testing::MeshSource source(*floor);
  SourceContacts query;
  std::vector<Contact> found;
  query.find(ring, source, {Mat3::Identity(), Vec3(3, 2, -0.2)}, 0.02, found);
  EXPECT_FALSE(found.empty());
  EXPECT_EQ(source.queries, 1u);
}

TEST(SourceContacts, hugeTrianglesAreTouchedWhereTheyAreTouched) {
  std::mt19937_64 random(44);
  const testing::SharedMesh mesh = testing::torus(1, 0.3, 16, 8);
  const ClusteredOctree ring = ClusteredOctree::build(mesh);
  SourceContacts query;
  std::vector<Contact> found;
  int hits = 0;
  constexpr int kPoses = 100;
  for (int i = 0; i < kPoses; ++i) {
    const TriangleMesh floor({Vec3(-3e6, -2e6, 0), Vec3(3e6, -2e6, 0), Vec3(0, 4e6, 0)}, {{0, 1, 2}});
    const Mat3 rotation = testing::randomRotation(random);
    const Pose pose{rotation, rotation * Vec3(0, 0, testing::uniform(random, -2.1, 2.1))};
    const auto expected = testing::bruteForceContacts(*mesh, floor, pose, i % 2 ? 0.02 : 0.0);
    query.find(ring, testing::MeshSource(floor), pose, i % 2 ? 0.02 : 0.0, found);
    ASSERT_EQ(found.size(), expected.size()) << "pose " << i;
    hits += !found.empty();
  }
  EXPECT_GE(hits, kPoses * 3 / 10);
  EXPECT_LE(hits, kPoses * 7 / 10);
}

TEST(SourceContacts, whatIsNotFiniteTouchesNothing) {
  class Holes final : public TriangleSource {
   public:
    Aabb bounds() const override {
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      return {Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)};
    }
    void forEachTriangleIn(const Aabb&, FunctionRef<void(const SourceTriangle&)> visit) const override {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      visit({{Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, nan, 0)}, 2, 1});
      visit({{Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)}, 2, 1});
      visit({{Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)}, 2, 1});  // again
    }
  };
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  SourceContacts query;
  std::vector<Contact> found;
  query.find(box, Holes(), {}, 0.0, found);
  ASSERT_EQ(found.size(), 8u);  // the sides, once each
  for (const Contact& contact : found) {
    EXPECT_EQ(query.triangle(contact.triangle_b).part, 2);
    EXPECT_EQ(contact.triangle_b, 0u);
  }
  Pose nowhere;
  nowhere.translation.x() = std::numeric_limits<double>::quiet_NaN();
  query.find(box, Holes(), nowhere, 0.0, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace octoblisk
