// Orients the triangles of a mesh.
#pragma once

#include <cstddef>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The volume that the triangles enclose, by the divergence theorem about the middle of the mesh (mm³):
/// negative if they face inward. For an open mesh its sign is the orientation of the greater part.
double enclosedVolume(const TriangleMesh& mesh);

/// The same mesh with every triangle reversed; indices stay.
TriangleMesh turned(const TriangleMesh& mesh);

/// The same mesh with all triangles of a part on the same side of it. Across an edge of two triangles, a
/// triangle is reversed if it uses the edge in the same direction as the other. In each part the smaller
/// number is reversed; `turned` is the total. Vertices at equal coordinates count as one. Throws
/// std::invalid_argument for a one-sided surface.
TriangleMesh withOneWinding(const TriangleMesh& mesh, std::size_t& turned);

}  // namespace octoblisk::demos
