// The storage of TriangleCache.
#pragma once

#include <array>
#include <cstdint>

#include "simd/box8.h"
#include "tree/leaf_vertices.h"

namespace octoblisk::detail {

/// Up to eight triangles with their corners in the frame of a box (leaf_vertices.h).
struct TriangleBundle {
  BoxF box;
  LeafVertices corners;
  std::array<std::uint32_t, kLanes> triangles;
  std::uint32_t count;
};

}  // namespace octoblisk::detail
