// The corners of a leaf's triangles in the frame of its box, where single precision is more accurate.
#pragma once

#include <cstdint>
#include <span>

#include "octoblisk/triangle_mesh.h"
#include "simd/box8.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// A buffer for the corners of one leaf, initially uninitialised.
struct LeafVertices {
  float rows[9 * kLanes];

  LeafVertices() {}  // NOLINT(modernize-use-equals-default): {} must not initialise it either
};

/// Writes the triangles' corners in the frame of a box that is relative to the origin: nine rows (x, y, z of
/// each corner in turn), each with one number per triangle.
void writeLeafVertices(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles, const BoxF& box,
                       const Vec3& origin, float* rows);

/// Writes the corners in all leaves of a full tree.
void writeAllLeafVertices(OwnedArrays& tree, const TriangleMesh& mesh, int threads);

}  // namespace octoblisk::detail
