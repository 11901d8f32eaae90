#include "report/replay_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tree/tree.h"

namespace octoblisk::demos {

using namespace detail;
namespace {

/// The approximate distance from the box to the nearest of the places; negative if one is inside the ball
/// around the box.
double distanceTo(const Obb& box, std::span<const Vec3> places) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& place : places) least = std::min(least, (place - box.center).squaredNorm());
  return std::sqrt(least) - box.half_extents.norm();
}

std::vector<Slot> slotsBelow(const Tree& tree, std::span<const Slot> slots) {
  std::vector<Slot> below;
  for (const Slot slot : slots) {
    const Child child = tree.child(slot);
    if (child.isLeaf()) continue;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Slot next{child.node(), lane};
      if (!tree.child(next).isEmpty()) below.push_back(next);
    }
  }
  return below;
}

}  // namespace

ReplayBoxes replayBoxesOf(const ClusteredOctree& octree, std::span<const Vec3> places, std::size_t most) {
  const Tree& tree = treeOf(octree);
  ReplayBoxes found;
  found.deepest = tree.stats().depth - 1;
  std::vector<Slot> level = {Tree::kRoot};
  bool is_whole = true;
  for (int depth = 0; !level.empty(); ++depth) {
    const std::size_t room = most > found.boxes.size() ? most - found.boxes.size() : 0;
    const auto levels_left = static_cast<std::size_t>(std::max(1, found.deepest - depth + 1));
    // A truncated level leaves the levels below it their share.
    if (depth > 0 && (level.size() > room || !is_whole)) {
      is_whole = false;
      const std::size_t share = std::min(level.size(), room / levels_left);
      std::vector<std::pair<double, std::size_t>> distances;
      for (std::size_t i = 0; i < level.size(); ++i)
        distances.emplace_back(distanceTo(tree.box(level[i]), places), i);
      std::ranges::nth_element(distances, distances.begin() + static_cast<std::ptrdiff_t>(share));
      distances.resize(share);
      std::ranges::sort(distances, {}, &std::pair<double, std::size_t>::second);
      std::vector<Slot> kept;
      for (const auto& [distance, i] : distances) kept.push_back(level[i]);
      level = std::move(kept);
    }
    if (is_whole) found.whole_to = depth;
    for (const Slot slot : level) found.boxes.push_back({tree.box(slot), depth, tree.child(slot).isLeaf()});
    level = slotsBelow(tree, level);
  }
  return found;
}

}  // namespace octoblisk::demos
