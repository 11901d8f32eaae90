#include "report/replay_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "models/blisk.h"

namespace octoblisk::demos {
namespace {

TEST(ReplayBoxes, haveTheBoxesOfEachLevelOfTheTree) {
  const auto tree =
      ClusteredOctree::build(std::make_shared<const TriangleMesh>(makeDefaultBlisk(10'000).mesh));
  const std::vector<Vec3> places = {tree.mesh().vertices().front()};
  const ReplayBoxes all = replayBoxesOf(tree, places, 1'000'000);
  EXPECT_EQ(all.deepest, all.whole_to);
  EXPECT_EQ(all.deepest + 1, tree.stats().depth);
  for (int depth = 0; depth <= all.deepest; ++depth) {
    std::size_t shown = 0;
    double volume = 0.0, expected_volume = 0.0;
    for (const ReplayBox& each : all.boxes) {
      if (each.depth != depth && !(each.is_leaf && each.depth < depth)) continue;
      ++shown;
      volume += each.box.volume();
    }
    const std::vector<Obb> expected = tree.boxes(depth);
    for (const Obb& box : expected) expected_volume += box.volume();
    EXPECT_EQ(shown, expected.size()) << "depth " << depth;
    EXPECT_NEAR(volume, expected_volume, 1e-9 * expected_volume) << "depth " << depth;
  }

  const std::size_t most = all.boxes.size() / 3;
  const ReplayBoxes some = replayBoxesOf(tree, places, most);
  EXPECT_LE(some.boxes.size(), most);
  EXPECT_GT(some.boxes.size(), most / 2);
  EXPECT_LT(some.whole_to, some.deepest);
  const int deepest_shown = std::ranges::max(some.boxes, {}, &ReplayBox::depth).depth;
  EXPECT_GT(deepest_shown, some.whole_to);
  // The kept leaves are nearer to the place than the others.
  double farthest = 0.0, mean = 0.0;
  std::size_t leaves = 0;
  for (const ReplayBox& each : some.boxes) {
    if (each.depth > some.whole_to) farthest = std::max(farthest, (each.box.center - places[0]).norm());
  }
  for (const ReplayBox& each : all.boxes) {
    if (each.depth <= some.whole_to) continue;
    mean += (each.box.center - places[0]).norm();
    ++leaves;
  }
  EXPECT_LT(farthest, mean / static_cast<double>(leaves));
}

}  // namespace
}  // namespace octoblisk::demos
