// Where a point lies in relation to a mesh that is known to be closed.
#pragma once

#include "octoblisk/containment.h"

namespace octoblisk::detail {

/// Like locate for a closed surface, but without a Surface.
PointLocation locateInClosed(const ClusteredOctree& tree, const Vec3& point, const Pose& tree_in_a = {});

}  // namespace octoblisk::detail
