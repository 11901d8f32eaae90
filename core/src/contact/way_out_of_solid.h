// The contact that pushes a body out of a closed mesh.
#pragma once

#include <limits>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/function_ref.h"

namespace octoblisk::detail {

/// A contact that pushes B out of A along the line from a point inside to the closest point of the surface.
/// `farthest_of_b(direction)` is the farthest point of B, or of the part of B that is to get out. The surface
/// is no farther away than `upper_bound`.
Contact wayOutOfSolid(const ClusteredOctree& a, const Vec3& inside,
                      FunctionRef<Vec3(const Vec3& direction)> farthest_of_b,
                      double upper_bound = std::numeric_limits<double>::infinity());

}  // namespace octoblisk::detail
