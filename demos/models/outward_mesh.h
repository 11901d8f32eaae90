// A user's mesh, with all its triangles facing outward.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Depths and normals are measured along the triangles' outward normals. So triangles that face the other way
/// than those beside them are turned (orientation.h), and all are where the mesh faces inward. A note, of one
/// line that names the file, for either. Throws as readMesh, and std::runtime_error naming a file whose
/// surface has one side alone.
TriangleMesh readOutward(const std::filesystem::path& file, std::vector<std::string>& notes);

}  // namespace octoblisk::demos
