// Tests that all triangles with a corner or an edge are found, among few triangles and among many.
#include "contact/shared_corners.h"

#include <gtest/gtest.h>

#include <set>

#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

TEST(SharedCorners, find_vs_allTriangles) {
  constexpr std::uint32_t kTriangles = 72;
  const testing::SharedMesh sheet = testing::waveSheet(3, 0.2, 6);
  ASSERT_EQ(sheet->triangleCount(), kTriangles);
  SharedCorners corners, edges;
  std::size_t at_corner = 0, along_edge = 0;
  for (int round = 0; round < 2; ++round) {  // the second one reuses the buffers
    corners.clear();
    edges.clear();
    for (std::uint32_t count = 1; count <= kTriangles; ++count) {
      const auto triangleOf = [&](std::uint32_t number) { return sheet->triangle(number); };
      corners.addCorners(triangleOf);
      edges.addEdges(triangleOf);
      for (std::uint32_t one = 0; one < count; ++one) {
        const Triangle triangle = sheet->triangle(one);
        for (std::size_t v = 0; v < 3; ++v) {
          const Vec3 &from = triangle[v], &to = triangle[(v + 1) % 3];
          std::set<std::uint32_t> at, along;
          const auto gather = [](std::set<std::uint32_t>& into) {
            return [&into](std::uint32_t number) {
              EXPECT_TRUE(into.insert(number).second) << number << " is visited twice";
              return false;
            };
          };
          EXPECT_FALSE(corners.anyAt(from, gather(at)));
          EXPECT_FALSE(edges.anyAlong(to, from, gather(along)));
          const std::size_t most = count > 16 ? 6 : count;  // the table finds no others
          EXPECT_LE(at.size(), most);
          for (std::uint32_t other = 0; other < count; ++other) {
            const Triangle shares = sheet->triangle(other);
            const bool has_corner = hasCorner(shares, from), has_edge = has_corner && hasCorner(shares, to);
            EXPECT_TRUE(!has_corner || at.contains(other));
            EXPECT_TRUE(!has_edge || along.contains(other));
            at_corner += has_corner;
            along_edge += has_edge;
          }
        }
      }
    }
  }
  // A triangle shares corners with up to 12 others, edges with up to 3.
  EXPECT_GT(along_edge, 4 * kTriangles * kTriangles);
  EXPECT_GT(2 * at_corner, 3 * along_edge);
}

}  // namespace
}  // namespace octoblisk
