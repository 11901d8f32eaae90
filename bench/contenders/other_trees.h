// Trees that no option of the library builds. They are made from the arrays of a tree that it can build, and
// show what the library's choices gain.
#pragma once

#include "octoblisk_trees.h"

namespace octoblisk::bench {

enum class Aligned {
  all,     ///< every box
  leaves,  ///< boxes around leaves
  inner,   ///< all other boxes
};

/// The same nodes, with boxes along the axes of the mesh instead of oriented boxes.
MakeTree axisAligned(Aligned boxes);

/// The same leaves and boxes, but at most `children` children to a node, 2 to 7. A larger node becomes
/// several, one below the other, each with the principal box of its contents. The boxes are still tested
/// eight at a time, so lanes are idle. This shows what filling the lanes gains.
MakeTree narrowed(std::size_t children);

}  // namespace octoblisk::bench
