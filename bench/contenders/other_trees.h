// Trees that no option of the library builds, made of the arrays of one that it does: what its choices buy.
#pragma once

#include "octoblisk_trees.h"

namespace octoblisk::bench {

enum class Aligned {
  all,     ///< every box
  leaves,  ///< those round leaves
  inner,   ///< all others
};

/// The same nodes, with boxes along the axes of the mesh instead of their own.
MakeTree axisAligned(Aligned boxes);

/// The same leaves and boxes, but nodes of 2 to 7 children at most: a node of more becomes several, one below
/// the other, each with the principal box of what it holds. The boxes are tested eight at a time as ever, so
/// that lanes are idle: it tells what filling them buys.
MakeTree narrowed(std::size_t children);

}  // namespace octoblisk::bench
