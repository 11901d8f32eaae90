// Bullet's mesh interface read into a mesh of the core.
#pragma once

#include <vector>

#include "octoblisk/triangle_mesh.h"

class btStridingMeshInterface;

namespace octoblisk {

struct InterfaceMesh {
  TriangleMesh mesh;                      ///< unscaled, all parts one after the other
  std::vector<std::uint32_t> part_begin;  ///< the first triangle of each part
};

/// Reads any vertex type (float, double), index type (32, 16 or 8 bits), stride and number of parts.
/// Throws std::invalid_argument where there are no triangles; that names the part, where a type is none of
/// these, a count is below 0, a pointer is null or a stride is 0; the part and its triangle, where an index
/// is out of range; the vertex, counted over all parts, where a coordinate is not finite or beyond
/// TriangleMesh::kMaxCoordinate.
InterfaceMesh readMeshInterface(const btStridingMeshInterface& source);

}  // namespace octoblisk
