// Trees and ray hits are the same to the last bit on every instruction set of the machine.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "core/only_targets.h"
#include "octoblisk/batch.h"
#include "octoblisk/raycast.h"
#include "query/triangles_along.h"
#include "shared/meshes.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

struct Answers {
  std::vector<TreeNode> nodes;
  std::vector<std::uint32_t> order;
  std::vector<double> t;
  std::size_t hits = 0;

  bool operator==(const Answers& other) const {
    return order == other.order && t == other.t && nodes.size() == other.nodes.size() &&
           std::memcmp(nodes.data(), other.nodes.data(), nodes.size() * sizeof nodes[0]) == 0;
  }
};

Answers answers(const testing::SharedMesh& mesh, BuildQuality quality) {
  const ClusteredOctree tree = ClusteredOctree::build(mesh, {.quality = quality});
  Answers all;
  all.nodes.assign(treeOf(tree).nodes().begin(), treeOf(tree).nodes().end());
  all.order.assign(treeOf(tree).triangleOrder().begin(), treeOf(tree).triangleOrder().end());
  std::mt19937_64 random(8);
  std::vector<Ray> rays;
  for (int i = 0; i < 2000; ++i) {
    Ray ray;
    ray.origin = testing::randomPoint(random, 4.0);
    ray.direction = testing::randomPoint(random, 1.0) - 0.25 * ray.origin;
    const auto hit = closestHit(tree, ray);
    rays.push_back(ray);
    all.hits += hit.has_value();
    all.t.push_back(hit ? hit->t : -1.0);
    const MovingBox box{.start = {ray.origin, Mat3::Identity(), Vec3::Constant(0.05)},
                        .motion = ray.direction};
    forEachTriangleAlong(tree, box, 1.0, [&](std::uint32_t triangle, double first) {  // in the order visited
      all.t.insert(all.t.end(), {double(triangle), first});
      return 1.0;
    });
  }
  for (const auto& hit : closestHitAll(tree, rays, 1)) all.t.push_back(hit ? hit->t : -1.0);
  return all;
}

TEST(InstructionSets, giveTheSameBits) {
  std::mt19937_64 random(7);
  for (const testing::SharedMesh& mesh :
       {testing::torus(3, 1, 120, 60), testing::fan(12, 20), testing::soup(random, 5000, 10, 0.3)}) {
    for (const BuildQuality quality : {BuildQuality::high, BuildQuality::low}) {
      const Answers best = answers(mesh, quality);
      for (const std::int64_t target : testing::compiledTargets()) {
        const testing::OnlyTargets only(target);
        EXPECT_EQ(answers(mesh, quality), best) << std::hex << target;
      }
      EXPECT_GT(best.hits, 0u);
    }
  }
}

}  // namespace
}  // namespace octoblisk
