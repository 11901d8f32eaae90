// Reads a user's mesh and makes all its triangles face outward.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Depths and normals are measured along the triangles' outward normals. So triangles that face the opposite
/// way to their neighbours are reversed (orientation.h), and all triangles are reversed if the mesh faces
/// inward. Each case adds a one-line note that names the file. Throws as readMesh, and std::runtime_error
/// naming a file with a one-sided surface.
TriangleMesh readOutward(const std::filesystem::path& file, std::vector<std::string>& notes);

}  // namespace octoblisk::demos
