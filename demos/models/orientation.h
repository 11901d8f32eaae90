// Which way the triangles of a mesh face.
#pragma once

#include <cstddef>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The volume that the triangles enclose, by the divergence theorem about the middle of the mesh (mm³):
/// negative where they face inward. Of an open mesh its sign tells the way that most of it faces.
double enclosedVolume(const TriangleMesh& mesh);

/// The same mesh with every triangle facing the other way; indices stay.
TriangleMesh turned(const TriangleMesh& mesh);

/// The same mesh with all triangles of a part facing the same side of it: walking over edges that two
/// triangles share, those are turned that use the edge the same way as the other. Of each part the fewer are
/// turned; `turned` is their number. Vertices at equal coordinates count as one. Throws std::invalid_argument
/// where there is no such way: a surface with one side.
TriangleMesh withOneWinding(const TriangleMesh& mesh, std::size_t& turned);

}  // namespace octoblisk::demos
