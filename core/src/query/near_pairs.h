// All pairs of triangles of two meshes that are near each other.
#pragma once

#include <vector>

#include "query/near_pair.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Replaces `near` with all triangle pairs that are no farther apart than `threshold` (>= 0, mesh units), and
/// some that are slightly farther. Pairs with a thin triangle may be farther by up to its width. With a
/// threshold of 0, leaves out pairs that surely do not meet. The order is arbitrary. Allocates nothing if the
/// capacity of `near` suffices.
void nearPairs(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold,
               std::vector<NearPair>& near);

}  // namespace octoblisk::detail
