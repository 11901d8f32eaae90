// Reads and writes triangle meshes as STL, OBJ or PLY.
#pragma once

#include <filesystem>
#include <string_view>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Reads .stl (binary or ASCII), .obj or .ply. Divides polygons into triangles; ignores points and lines.
/// Triangles keep their order, and even degenerate ones are kept. Vertices with equal coordinates are merged,
/// and unused vertices are dropped. Coordinates are rounded to the nearest 32-bit floats.
///
/// Throws std::runtime_error with a one-line message that names the file, and the line (counted from 1) or
/// triangle (counted from 0) if there is one: for a missing file, an unknown extension, an empty or truncated
/// file, no triangles, a value that is not a number, an index without a vertex, or a coordinate that is NaN,
/// beyond single precision or too large for a mesh. An OBJ does not declare its counts, so truncation shows
/// only as an incomplete last line or a missing vertex.
TriangleMesh readMesh(const std::filesystem::path& file);

/// The same for a file whose bytes are already in memory.
TriangleMesh readMesh(const std::filesystem::path& file, std::string_view bytes);

/// Throws std::runtime_error naming the file unless its extension is that of a mesh.
void requireMeshFormat(const std::filesystem::path& file);

/// Writes a binary .stl, an .obj or a binary .ply, depending on the extension. Coordinates are rounded to
/// 32-bit floats. Throws std::runtime_error naming the file: for an unknown extension, or a file that cannot
/// be written.
void writeMesh(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace octoblisk::demos
