// All pairs of triangles of two meshes that are near each other.
#pragma once

#include <vector>

#include "query/near_pair.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Replaces `near` with all triangle pairs that are no farther apart than the distance that it returns, and
/// some that are slightly farther. This distance is `threshold` (>= 0, mesh units), or less if many pairs are
/// within the threshold. It is then larger than the distance of the nearest pair: by at least a tenth of the
/// threshold or 1/500 of the smaller tree's radius, whichever is less. Pairs with a thin triangle may be
/// farther by up to its width. With a threshold of 0, leaves out pairs that surely do not meet. The order is
/// arbitrary. Allocates nothing if the capacity of `near` suffices.
double nearPairs(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold,
                 std::vector<NearPair>& near);

}  // namespace octoblisk::detail
