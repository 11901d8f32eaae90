// The thickness of the thin parts of a solid.
#pragma once

#include "octoblisk/clustered_octree.h"

namespace octoblisk::detail {

/// The thickness, in mesh units, that a tenth of the surface of a closed mesh, which faces outward, falls
/// below. The thickness at a point of the surface is the length of a ray inward until it leaves the solid. It
/// is measured at 64 triangles, spread evenly over the area.
double thinThickness(const ClusteredOctree& tree);

}  // namespace octoblisk::detail
