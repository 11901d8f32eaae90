// All pairs of triangles of two meshes that are near each other.
#pragma once

#include <vector>

#include "query/near_pair.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Returns a distance, and replaces `near` with all triangle pairs within this distance. Some pairs may be
/// slightly farther apart; pairs with a thin triangle by up to its width. The distance is `threshold` (>= 0,
/// mesh units). If many pairs are within the threshold, it is less, but at least the distance of the nearest
/// pair plus `surplus`. With a threshold of 0, leaves out pairs that surely do not
/// meet. The order is arbitrary. Allocates nothing if the capacity of `near` suffices.
double nearPairs(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold, double surplus,
                 std::vector<NearPair>& near);

}  // namespace octoblisk::detail
