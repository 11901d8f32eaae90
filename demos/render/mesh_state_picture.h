// Draws a mesh and its defects.
#pragma once

#include <string>

#include "octoblisk/inspection.h"
#include "render/picture.h"

namespace octoblisk::demos {

/// The mesh with sheets and with triangles that face inward, intersect others or are inside in colours, and
/// lines around holes, along cracks and at T-junctions. `length_unit`: of the scale bar; empty for none.
Picture meshStatePicture(const octoblisk::Surface& surface, const MeshInspection& found,
                         const std::string& length_unit);

}  // namespace octoblisk::demos
