// All pairs of triangles of two meshes that are near each other.
#pragma once

#include <vector>

#include "query/near_pair.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Replaces `near` with all triangle pairs that are no farther apart than `threshold` (>= 0, mesh units), and
/// some that are farther: hardly, or, if a triangle is thin, by up to 1/16 of its length. They are in no
/// particular order. With a threshold of 0, pairs that do not meet are
/// left out. Allocates nothing if the capacity of `near` suffices.
void nearPairs(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold,
               std::vector<NearPair>& near);

}  // namespace octoblisk::detail
