// Selects the boxes of a tree that a replay shows, level by level.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

struct ReplayBox {
  Obb box;
  int depth = 0;  ///< 0 for the root
  bool is_leaf = false;
};

struct ReplayBoxes {
  std::vector<ReplayBox> boxes;  ///< by depth
  int deepest = 0;
  int whole_to = 0;  ///< up to this depth all boxes are included, deeper only those near `places`
};

/// At most `most` boxes, but at least one: all boxes of as many levels as fit, and for each deeper level a
/// share of those nearest to one of the places.
ReplayBoxes replayBoxesOf(const ClusteredOctree& tree, std::span<const Vec3> places, std::size_t most);

}  // namespace octoblisk::demos
