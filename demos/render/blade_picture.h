// Draws the blades found on a mesh.
#pragma once

#include "models/blade_anatomy.h"
#include "models/blisk_axis.h"
#include "render/picture.h"

namespace octoblisk::demos {

/// The mesh, with its blades' sides, tips and edges in colours, and the axis, seen from the leading edges.
/// The mesh is given in the blisk's frame.
Picture bladePicture(const TriangleMesh& blisk, const BliskFound& found, const BliskAnatomy& anatomy,
                     BladeSide convex_side);

}  // namespace octoblisk::demos
