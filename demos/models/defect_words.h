// Names the defects of a mesh that change verdicts.
#pragma once

#include <string>

#include "octoblisk/inspection.h"

namespace octoblisk::demos {

/// Where triangles bound no solid: "16 of its edges are open, the first from (0 0 1) to (0 1 1); triangles
/// face opposite ways at 2 of its edges, the first at triangle 7". If there are no such edges: "3 of its
/// triangles bound no solid, the first number 7". Empty if the whole mesh bounds a solid. Edges of
/// T-junctions and cracks do not count.
std::string openText(const MeshInspection& found);

/// "2 of its triangles face inward, the first number 7", "it faces inward"; empty if none do.
std::string inwardText(const MeshInspection& found);

/// The inspection of a mesh, for these words: it takes little time, and finds nothing else, if the mesh is a
/// simple solid (query/simple_solid.h).
MeshInspection defectsOf(const ClusteredOctree& tree, int threads = 0);

}  // namespace octoblisk::demos
