// The descent of a ray through a tree, boxes and triangles eight at a time.
#pragma once

#include <cstdint>
#include <span>

#include "octoblisk/function_ref.h"
#include "octoblisk/raycast.h"

namespace octoblisk::detail {

/// Receives a triangle that a ray may cross or touch. Returns the greatest t still of interest, or a negative
/// number to stop.
using CandidateVisitor = FunctionRef<double(std::uint32_t triangle)>;

/// Calls visit(triangle) for every triangle that the ray crosses or touches, and for few others, entering
/// boxes by ascending t, as long as t is of interest. `rounding`: the error of the ray's own points. Ignores
/// cull_back_faces.
void forEachCandidate(const Tree& tree, const Ray& ray, double rounding, CandidateVisitor visit);

/// A CandidateVisitor for many rays. It also receives the index of the ray.
using RayCandidateVisitor = FunctionRef<double(std::size_t ray, std::uint32_t triangle)>;

/// Calls visit(ray, triangle) for the candidates of each ray, in the same order as for a single ray without
/// rounding of its points. Advances several rays in turn: while one waits for memory, the others go on.
void forEachCandidate(const Tree& tree, std::span<const Ray> rays, RayCandidateVisitor visit);

}  // namespace octoblisk::detail
