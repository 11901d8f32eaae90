// Checks that the bytes of a mesh file are complete and valid.
#pragma once

#include <string>
#include <string_view>

namespace octoblisk::demos {

// assimp 5.2 reads a truncated text as a shorter mesh, and for a truncated or out-of-range PLY it reads
// beyond its memory. These functions find such faults before assimp sees the bytes. They throw
// std::runtime_error with a one-line message that begins with the file's name, followed by ":LINE" if the
// fault is in a line of text.

/// Binary STL: the header's count must match the size. ASCII STL: facets need three numeric vertices, and
/// each solid an endsolid.
void checkStl(std::string_view bytes, const std::string& file);

/// OBJ: vertices need three numbers, faces at least three corners, and each index a vertex.
void checkObj(std::string_view bytes, const std::string& file);

/// PLY, ASCII or binary: every declared element must exist, and each index needs a vertex.
void checkPly(std::string_view bytes, const std::string& file);

}  // namespace octoblisk::demos
