// The descent of a ray through a tree, boxes and triangles eight at a time.
#pragma once

#include <cstdint>

#include "octoblisk/raycast.h"

namespace octoblisk::detail {

/// Receives a triangle that a ray may cross or touch. Returns the greatest t still of interest, or a negative
/// number to stop.
using CandidateVisitor = double (*)(void* context, std::uint32_t triangle);

/// Calls the visitor for every triangle that the ray crosses or touches, and for few others, entering boxes
/// by ascending t, as long as t is of interest. `rounding`: the error of the ray's own points. Ignores
/// cull_back_faces.
void walkRay(const Tree& tree, const Ray& ray, double rounding, CandidateVisitor visitor, void* context);

/// walkRay for any callable.
template <typename Visit>
void forEachCandidate(const Tree& tree, const Ray& ray, double rounding, Visit visit) {
  walkRay(
      tree, ray, rounding,
      [](void* function, std::uint32_t triangle) { return (*static_cast<Visit*>(function))(triangle); },
      &visit);
}

}  // namespace octoblisk::detail
