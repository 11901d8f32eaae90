// The boxes of a tree, as a replay shows them a level at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

struct ReplayBox {
  Obb box;
  int depth = 0;  ///< the root's is 0
  bool is_leaf = false;
};

struct ReplayBoxes {
  std::vector<ReplayBox> boxes;  ///< by depth
  int deepest = 0;
  int whole_to = 0;  ///< depths up to it have all their boxes, deeper ones those near `places`
};

/// At most `most` boxes (but one at least): all of as many levels as that allows, and below those a share for
/// each level of the boxes that are nearest to one of the places.
ReplayBoxes replayBoxesOf(const ClusteredOctree& tree, std::span<const Vec3> places, std::size_t most);

}  // namespace octoblisk::demos
