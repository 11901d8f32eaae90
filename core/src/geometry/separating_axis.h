// Whether two oriented boxes overlap, by the separating axis theorem (section 3.3, eq. 6–11 of the paper;
// S. Gottschalk, M. C. Lin, D. Manocha, OBBTree, 1996).
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::detail {

enum class SeparatingAxes {
  exact15,  ///< three face axes of each box and nine edge cross products: an exact test of overlap
  first_x,  ///< the paper's test, only the first box's X axis: misses no overlap, often reports a false one
};

/// False if one of the axes separates the boxes (eq. 11; boxes that touch overlap). Skips cross products of
/// nearly parallel edges. Due to rounding, boxes that barely fail to touch may count as overlapping, but
/// never the reverse.
bool overlaps(const Obb& a, const Obb& b, SeparatingAxes axes = SeparatingAxes::exact15);

}  // namespace octoblisk::detail
