// Where a point lies, for a mesh that is known to be closed.
#pragma once

#include "octoblisk/containment.h"

namespace octoblisk::detail {

/// What locate says of a closed surface, without the surface.
PointLocation locateInClosed(const ClusteredOctree& tree, const Vec3& point, const Pose& tree_in_a = {});

}  // namespace octoblisk::detail
