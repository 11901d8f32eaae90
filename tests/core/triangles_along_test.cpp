// Compares the triangles that a moving box meets with a test of every triangle at many times.
#include "query/triangles_along.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "octoblisk/raycast.h"
#include "shared/brute_force.h"
#include "shared/solids.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::SharedMesh;
using testing::uniform;

std::map<std::uint32_t, double> visited(const ClusteredOctree& tree, const MovingBox& box,
                                        double last = 1.0) {
  std::map<std::uint32_t, double> found;
  forEachTriangleAlong(tree, box, last, [&](std::uint32_t triangle, double first) {
    EXPECT_TRUE(found.emplace(triangle, first).second) << "twice: triangle " << triangle;
    return 1.0;
  });
  return found;
}

/// A box of up to the given half extents that moves past a vertex of the mesh and misses it by up to `miss`.
/// The box may stop before the vertex.
MovingBox randomBox(std::mt19937_64& random, const TriangleMesh& mesh, double extent, double miss) {
  MovingBox box;
  box.start = {testing::randomPoint(random, 4.0), testing::randomRotation(random),
               testing::randomPoint(random, extent).cwiseAbs()};
  const Vec3 vertex = mesh.vertices()[random() % mesh.vertices().size()];
  const Vec3 target = vertex + testing::randomPoint(random, miss);
  box.motion = uniform(random, 0.3, 1.5) * (target - box.start.center);
  if (random() % 4 == 0) box.motion[int(random() % 3)] = 0.0;
  return box;
}

/// The first fraction, in steps, at which a box overlaps a triangle; above 1 if it never does.
double firstSeen(const MovingBox& box, const Triangle& triangle, int steps) {
  for (int step = 0; step <= steps; ++step) {
    const double fraction = double(step) / steps;
    Obb there = box.start;
    there.center += fraction * box.motion;
    if (testing::boxTriangleOverlap(there, triangle) > 0.0) return fraction;
  }
  return 2.0;
}

TEST(TrianglesAlong, movingBoxes_vs_bruteforce) {
  std::mt19937_64 random(57);
  struct Scene {
    SharedMesh mesh;
    double miss;
  };
  for (const Scene& scene : {Scene{testing::torus(2, 0.7, 24, 12), 1.0}, Scene{testing::fan(7, 12), 0.2},
                             Scene{testing::soup(random, 400, 2, 0.8), 1.5}}) {
    const SharedMesh& mesh = scene.mesh;  // Clang 14 captures no structured binding
    const ClusteredOctree tree = ClusteredOctree::build(mesh),
                          compact = ClusteredOctree::build(mesh, {.storage = Storage::compact});
    int hits = 0;
    std::size_t given = 0, seen = 0;
    constexpr int kBoxes = 50;
    for (int i = 0; i < kBoxes; ++i) {
      const MovingBox box = randomBox(random, *mesh, 0.15, scene.miss);
      const auto found = visited(tree, box), found_in_compact = visited(compact, box);
      double first_of_all = 2.0;
      for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
        const double first = firstSeen(box, mesh->triangle(t), 24);
        if (first > 1.0) continue;
        ++seen;
        first_of_all = std::min(first_of_all, first);
        const auto at = found.find(t);
        ASSERT_TRUE(at != found.end()) << "box " << i << ", triangle " << t;
        ASSERT_LE(at->second, first + 1e-12);
        ASSERT_TRUE(found_in_compact.contains(t)) << "box " << i << ", triangle " << t;
      }
      given += found.size();
      hits += first_of_all <= 1.0;
      for (const auto& [triangle, first] : visited(tree, box, 0.3)) EXPECT_LE(first, 0.3);
      // Lowering the limit leaves out triangles beyond it, but not the first one.
      double nearest = 2.0;
      forEachTriangleAlong(tree, box, 1.0, [&](std::uint32_t triangle, double) {
        nearest = std::min(nearest, firstSeen(box, mesh->triangle(triangle), 24));
        return std::min(nearest, 1.0);
      });
      EXPECT_EQ(nearest, first_of_all);
    }
    EXPECT_GT(hits, kBoxes * 3 / 10);
    EXPECT_LT(hits, kBoxes * 7 / 10);
    EXPECT_LT(given, 3 * seen);  // few extra triangles; the box meets most of them between two steps
  }
}

TEST(TrianglesAlong, segments_vs_raycast) {
  std::mt19937_64 random(54);
  const SharedMesh mesh = testing::fan(9, 16);
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  int hits = 0;
  std::size_t given = 0, crossed = 0;
  constexpr int kSegments = 2000;
  std::vector<RayHit> all;
  for (int i = 0; i < kSegments; ++i) {
    MovingBox segment = randomBox(random, *mesh, 0.0, 0.5);
    const bool long_way = i % 2 == 1;
    if (long_way) {  // from afar
      segment.start.center -= 1e4 * segment.motion;
      segment.motion *= 2e4;
    }
    allHits(tree, {segment.start.center, segment.motion, 1.0}, all);
    const auto found = visited(tree, segment);
    for (const RayHit& hit : all) {
      const auto at = found.find(hit.triangle);
      ASSERT_TRUE(at != found.end()) << "segment " << i << ", triangle " << hit.triangle;
      ASSERT_LE(at->second, hit.t * (1.0 + 1e-12));
    }
    hits += !all.empty();
    given += found.size();
    crossed += all.size();
  }
  EXPECT_GT(hits, kSegments * 3 / 10);
  EXPECT_LT(hits, kSegments * 7 / 10);
  EXPECT_LE(given, crossed + crossed / 100);
}

TEST(TrianglesAlong, theRimCounts) {
  const auto mesh = std::make_shared<const TriangleMesh>(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                                         std::vector<TriangleMesh::Indices>{{0, 1, 2}});
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  MovingBox segment;
  segment.start.half_extents.setZero();
  segment.start.center = Vec3(0.5, -0.001, 1.0);
  segment.motion = Vec3(0, 0, -2);
  EXPECT_TRUE(visited(tree, segment).empty());
  segment.rim = 0.01;
  EXPECT_EQ(visited(tree, segment).size(), 1u);
  segment.start.center.y() = -0.02;
  EXPECT_TRUE(visited(tree, segment).empty());
}

TEST(TrianglesAlong, standstillAndBadNumbers) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::torus(2, 0.7, 24, 12));
  MovingBox box;
  box.start = {Vec3(2, 0, 0.7), Mat3::Identity(), Vec3::Constant(0.2)};
  EXPECT_FALSE(visited(tree, box).empty());  // a box at rest is allowed
  box.start.center.z() = 2.0;
  EXPECT_TRUE(visited(tree, box).empty());
  box.start.center.z() = 0.7;
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const double bad : {inf, -inf, nan}) {
    MovingBox moving = box, placed = box, sized = box;
    moving.motion.x() = bad;
    placed.start.center.y() = bad;
    sized.start.half_extents.z() = bad;
    EXPECT_TRUE(visited(tree, moving).empty());
    EXPECT_TRUE(visited(tree, placed).empty());
    EXPECT_TRUE(visited(tree, sized).empty());
  }
  EXPECT_TRUE(visited(tree, box, nan).empty());
  EXPECT_TRUE(visited(tree, box, -1.0).empty());
  EXPECT_FALSE(visited(tree, box, inf).empty());
}

}  // namespace
}  // namespace octoblisk
