// The triangles near a convex body.
#pragma once

#include <cstdint>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/convex.h"
#include "octoblisk/function_ref.h"

namespace octoblisk {

/// Calls visit(triangle) for every triangle within `reach` of a convex body, and for some other
/// triangles nearby. Stops and returns true as soon as a call returns true; otherwise returns false.
bool forEachTriangleNear(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_tree,
                         double reach, FunctionRef<bool(std::uint32_t triangle)> visit);

}  // namespace octoblisk
