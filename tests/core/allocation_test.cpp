// Warm queries allocate nothing. The test counts every operator new of this program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "contact/contact_patches.h"
#include "contact/feature_contacts.h"
#include "contact/source_sheet.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/containment.h"
#include "octoblisk/depth.h"
#include "octoblisk/half_space_contacts.h"
#include "octoblisk/path_query.h"
#include "octoblisk/raycast.h"
#include "octoblisk/source_contacts.h"
#include "octoblisk/sweep.h"
#include "octoblisk/triangle_cache.h"
#include "query/triangles_along.h"
#include "shared/defective_meshes.h"
#include "shared/mesh_source.h"
#include "shared/meshes.h"

namespace {
std::atomic<std::size_t> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
// Otherwise GCC 12 inlines them, but not operator new, and reports a mismatch.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace octoblisk {

using namespace detail;

namespace {

TEST(Allocation, warmQueriesAllocateNothing) {
  const ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 12));
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
  const ConvexBox box({Vec3::Zero(), Mat3::Identity(), Vec3(0.4, 0.2, 0.1)});
  ContactPatches patches;
  TriangleCache near;
  std::vector<Contact> found;
  std::vector<RayHit> ray_hits;
  std::size_t hits = 0, along = 0;
  const auto queryAll = [&] {
    std::mt19937_64 random(61);
    for (int i = 0; i < 50; ++i) {
      const Pose pose = testing::randomPose(random, 1.2);
      const Motion motion(pose, testing::randomPose(random, 1.2));
      PathQuery query(fan, ring);
      for (const double fraction : {0.0, 0.01}) {
        hits += query.collide(motion.at(fraction)).has_value();
        query.distance(motion.at(fraction));
      }
      sweep(fan, ring, motion, 0.01);
      sweep(fan, box, motion, 0.01);
      hits += collide(fan, ring, pose).has_value() + collide(fan, box, pose).has_value();
      contacts(fan, ring, pose, 0.05, found);
      patches.reduce(found, 0.01);
      contacts(fan, box, pose, 0.05, found);
      patches.reduce(found, 0.01);
      contacts(fan, near.find(fan, box, pose, 0.05), box, pose, 0.05, found);
      const Ray ray{.origin = pose.translation, .direction = pose.rotation.col(0)};
      allHits(ring, ray, ray_hits);
      hits += anyHit(fan, ray) + closestHit(ring, ray).has_value();
      const MovingBox moving{.start = {pose.translation, pose.rotation, Vec3::Constant(0.1)},
                             .motion = pose.rotation.col(0)};
      forEachTriangleAlong(fan, moving, 1.0, [&](std::uint32_t, double) {
        ++along;
        return 1.0;
      });
    }
  };
  queryAll();
  const std::size_t before = allocations;
  EXPECT_GT(before, 0u);  // the counter counts
  queryAll();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(hits, 50u);
  EXPECT_GT(along, 50u);
}

TEST(Allocation, warmQueriesOfForeignBodiesAllocateNothing) {
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
  const testing::SharedMesh fan = testing::fan(9, 12);
  const testing::MeshSource source(*fan);
  SourceContacts query;
  std::vector<Contact> found;
  std::size_t hits = 0;
  const auto queryAll = [&] {
    std::mt19937_64 random(63);
    for (int i = 0; i < 50; ++i) {
      const Pose pose = testing::randomPose(random, 1.2);
      query.find(ring, source, pose, 0.05, found);
      hits += !found.empty();
      contacts(ring, HalfSpace{pose.rotation.col(0), pose.translation.x()}, 0.05, found);
    }
  };
  queryAll();
  const std::size_t before = allocations;
  queryAll();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(hits, 10u);
}

TEST(Allocation, warmQueriesOfFeaturesAllocateNothing) {
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
  const MeshFeatures features({ring, SolidMesh::Kind::simple});
  FeatureContacts query;
  std::vector<Contact> found;
  std::size_t hits = 0;
  const auto queryAll = [&] {
    std::mt19937_64 random(65);
    for (int i = 0; i < 50; ++i) {
      query.find(features, features, testing::randomPose(random, 1.2), {}, 0.05, 0.05, found);
      hits += found.empty() ? 0 : 1;
    }
  };
  queryAll();
  const std::size_t before = allocations;
  queryAll();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(hits, 10u);
}

TEST(Allocation, warmQueriesOfSheetsAllocateNothing) {
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
  const MeshFeatures features({ring, SolidMesh::Kind::simple});
  const testing::SharedMesh fan = testing::fan(9, 12);
  const testing::MeshSource source(*fan);
  SourceSheet sheet;
  FeatureContacts query;
  std::vector<Contact> found;
  std::size_t hits = 0;
  const auto queryAll = [&] {
    std::mt19937_64 random(64);
    for (int i = 0; i < 50; ++i) {
      const Pose pose = testing::randomPose(random, 1.2);
      sheet.read(source, fan->bounds());
      query.find(features, sheet.features(), pose, {}, 0.05, 0.05, found);
      query.find(features, sheet.features(), pose, Pose{pose.rotation, 1.1 * pose.translation}, 0.05, 0.05,
                 found);
      hits += found.empty() ? 0 : 1;
    }
  };
  queryAll();
  const std::size_t before = allocations;
  queryAll();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(hits, 10u);
}

TEST(Allocation, warmQueriesOfDefectiveSolidsAllocateNothing) {
  for (const testing::DefectiveMesh& defective : testing::defectiveMeshes()) {
    SCOPED_TRACE(defective.name);
    const ClusteredOctree tree = ClusteredOctree::build(defective.mesh);
    const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({0.2, 0.3, 0.1}));
    const Surface surface(tree), box_surface(box);
    DepthQuery query;
    std::size_t inside = 0;
    const auto queryAll = [&] {
      std::mt19937_64 random(65);
      for (int i = 0; i < 40; ++i) {
        const Pose pose = testing::randomPose(random, 1.5);
        const Vec3 center = pose * defective.mesh->bounds().center();
        inside += locate(surface, center, pose) == PointLocation::inside;
        inside += locate(surface, 0.7 * pose.translation) == PointLocation::inside;
        inside += containment(surface, box_surface, pose) == Containment::b_inside_a;
        query.deepest(surface, box_surface, pose, 1e-4);
        query.deepest(box_surface, surface, pose.inverse(), 1e-4);
      }
    };
    queryAll();
    const std::size_t before = allocations;
    queryAll();
    EXPECT_EQ(allocations, before);
    if (defective.is_closed) {
      EXPECT_GT(inside, 20u);
    }
  }
}

TEST(Allocation, warmQueriesOfSolidsAllocateNothing) {
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(1.0, 0.4, 24, 12));
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({0.4, 0.6, 0.2}));
  const Surface ring_surface(ring), box_surface(box);
  DepthQuery query;
  PathQuery path_query(ring_surface, box_surface);
  std::size_t hits = 0;
  const auto queryAll = [&] {
    std::mt19937_64 random(62);
    for (int i = 0; i < 50; ++i) {
      const Pose pose = testing::randomPose(random, 1.2);
      hits += query.deepest(ring_surface, box_surface, pose, 1e-4).gouging == Gouging::found;
      hits += containment(ring_surface, box_surface, pose) == Containment::touching;
      hits += closestPoint(ring, pose.translation, 0.3).has_value();
      hits += path_query.signedDistance(pose, {.tolerance = 1e-4}).distance < 0.0;
    }
  };
  queryAll();
  const std::size_t before = allocations;
  queryAll();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(hits, 50u);
}

}  // namespace
}  // namespace octoblisk
