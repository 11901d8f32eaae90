// The thickness of the thin parts of a solid.
#pragma once

#include "octoblisk/clustered_octree.h"

namespace octoblisk::detail {

/// The tenth percentile of the thickness over the surface of a closed mesh that faces outward, mesh units.
/// The thickness at a point of the surface is the length of a ray inward until it leaves the solid. It is
/// measured at 64 triangles, spread evenly over the area.
double thinThickness(const ClusteredOctree& tree);

}  // namespace octoblisk::detail
