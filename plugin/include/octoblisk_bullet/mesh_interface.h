// Reads a Bullet mesh interface into a mesh of the core.
#pragma once

#include <vector>

#include "octoblisk/triangle_mesh.h"

class btStridingMeshInterface;

namespace octoblisk {

struct InterfaceMesh {
  TriangleMesh mesh;                      ///< unscaled, all parts in sequence
  std::vector<std::uint32_t> part_begin;  ///< the first triangle of each part
};

/// Reads any vertex type (float, double), index type (32, 16 or 8 bits), stride and number of parts. Throws
/// std::invalid_argument
/// - if there are no triangles;
/// - if a type is unsupported, a count is negative, a pointer is null or a stride is 0; the message names the
///   part;
/// - if an index is out of range; the message names the part and the triangle;
/// - if a coordinate is not finite or beyond TriangleMesh::kMaxCoordinate; the message names the vertex,
///   counted over all parts.
InterfaceMesh readMeshInterface(const btStridingMeshInterface& source);

}  // namespace octoblisk
