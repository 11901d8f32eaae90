// Which way the triangles of a mesh face.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The volume that the triangles enclose, by the divergence theorem about the middle of the mesh (mm³):
/// negative where they face inward. Of an open mesh its sign tells the way that most of it faces.
double enclosedVolume(const TriangleMesh& mesh);

/// The same mesh with every triangle facing the other way; indices stay.
TriangleMesh turned(const TriangleMesh& mesh);

}  // namespace octoblisk::demos
