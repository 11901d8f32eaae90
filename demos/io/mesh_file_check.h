// Whether the bytes of a mesh file are a whole file.
#pragma once

#include <string>
#include <string_view>

namespace octoblisk::demos {

// assimp 5.2 reads a truncated text as a shorter mesh, and a truncated or out-of-range PLY beyond its
// memory. These functions find what it does not, before it sees the bytes. They throw std::runtime_error in
// one line that begins with the file's name, followed by ":LINE" where the fault is in a line of text.

/// STL, binary: the header's count against the size. ASCII: facets of three numeric vertices, and each solid
/// closed by endsolid.
void checkStl(std::string_view bytes, const std::string& file);

/// OBJ: vertices of three numbers, faces of three corners, and each index is of a vertex.
void checkObj(std::string_view bytes, const std::string& file);

/// PLY, ASCII or binary: every element the header announces is there, and each index is of a vertex.
void checkPly(std::string_view bytes, const std::string& file);

}  // namespace octoblisk::demos
