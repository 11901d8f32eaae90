// Reading and writing triangle meshes as STL, OBJ or PLY.
#pragma once

#include <filesystem>
#include <string_view>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Reads .stl (binary or ASCII), .obj or .ply. Polygons are cut into triangles; points and lines are passed
/// over. Triangles keep their order and none is dropped, be it degenerate; vertices at equal coordinates
/// become one, and vertices no triangle uses go. Coordinates are those of the nearest 32-bit floats.
///
/// Throws std::runtime_error in one line naming the file, and the line (counted from 1) or triangle
/// (counted from 0) where there is one: missing file, unknown extension, empty or truncated file, no
/// triangles, a value that is no number, an index of no vertex, a coordinate that is NaN, beyond single
/// precision or too large for a mesh. An OBJ announces no counts: that it is truncated shows only in an
/// incomplete last line or a missing vertex.
TriangleMesh readMesh(const std::filesystem::path& file);

/// The same for a file whose bytes are in memory already.
TriangleMesh readMesh(const std::filesystem::path& file, std::string_view bytes);

/// Writes by extension: binary .stl, .obj or binary .ply. Coordinates become 32-bit floats.
/// Throws std::runtime_error naming the file: unknown extension, or a file that cannot be written.
void writeMesh(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace octoblisk::demos
