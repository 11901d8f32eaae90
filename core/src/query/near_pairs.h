// All pairs of triangles of two meshes that are near each other.
#pragma once

#include <vector>

#include "query/near_pair.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Replaces `near` with all triangle pairs within a reach, and returns the reach. The reach is `threshold`
/// (>= 0, mesh units). If many pairs are within the threshold, the reach is less, but at least the distance
/// of the nearest pair plus `surplus`. Some pairs may be slightly farther apart than the reach; pairs with a
/// thin triangle, by up to its width. With a threshold of 0, leaves out pairs that surely do not meet. The
/// order is arbitrary. Allocates nothing if the capacity of `near` suffices.
double nearPairs(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold, double surplus,
                 std::vector<NearPair>& near);

}  // namespace octoblisk::detail
