#include "query/farthest_vertex.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shared/meshes.h"

namespace octoblisk::detail {
namespace {

TEST(FarthestVertex, equalsTheFarthestOfAllCorners) {
  std::mt19937_64 random(29);
  for (const testing::SharedMesh& mesh :
       {testing::torus(3, 1, 32, 16), testing::fan(9, 10), testing::soup(random, 300, 5, 0.4)}) {
    for (const Storage storage : {Storage::full, Storage::compact}) {
      const ClusteredOctree tree = ClusteredOctree::build(mesh, {.storage = storage});
      for (int i = 0; i < 200; ++i) {
        const Vec3 direction = testing::uniform(random, 0, 2) * testing::randomRotation(random).col(0);
        double expected = -1e300;
        for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
          for (const Vec3& corner : mesh->triangle(t)) expected = std::max(expected, direction.dot(corner));
        }
        EXPECT_EQ(direction.dot(farthestVertex(tree, direction)), expected);
      }
    }
  }
}

}  // namespace
}  // namespace octoblisk::detail
