// The triangles near an oriented box.
#pragma once

#include <cstdint>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/function_ref.h"

namespace octoblisk {

/// Calls visit(triangle) for every triangle within `reach` of a box in the mesh's frame, and for some
/// other triangles nearby. Stops and returns true as soon as a call returns true; otherwise returns false.
bool forEachTriangleIn(const ClusteredOctree& tree, const Obb& box_in_tree, double reach,
                       FunctionRef<bool(std::uint32_t triangle)> visit);

}  // namespace octoblisk
