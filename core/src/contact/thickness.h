// How thick the thin parts of a closed mesh are.
#pragma once

#include "octoblisk/clustered_octree.h"

namespace octoblisk::detail {

/// The thickness below which a tenth of the surface of a closed mesh lies, in mesh units. The thickness at a
/// point of the surface is the length of the straight way inward to where it leaves the solid. Measured at
/// some dozens of triangles, spread evenly over the area.
double thinThickness(const ClusteredOctree& tree);

}  // namespace octoblisk::detail
