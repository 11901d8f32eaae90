// Where a surface is open: the edges that keep it from bounding a solid.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

struct OpenEdges {
  std::size_t count = 0;
  std::array<Vec3, 2> first = {Vec3::Zero(), Vec3::Zero()};  ///< of the lowest triangle that has one
};

/// The edges that an odd number of triangles has; vertices at equal coordinates count as one. None of a
/// surface that octoblisk::Surface calls closed.
OpenEdges openEdges(const TriangleMesh& mesh);

/// "3 of its edges are open, the first from (0 0 1) to (0 1 1)", counted in words of one or many.
std::string describe(const OpenEdges& edges);

}  // namespace octoblisk::demos
