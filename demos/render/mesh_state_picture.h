// Draws a mesh and its defects.
#pragma once

#include "octoblisk/inspection.h"
#include "render/picture.h"

namespace octoblisk::demos {

/// The mesh, with the roles of its triangles in colours, and lines along holes, cracks and T-junctions.
Picture meshStatePicture(const octoblisk::Surface& surface, const MeshInspection& found);

}  // namespace octoblisk::demos
