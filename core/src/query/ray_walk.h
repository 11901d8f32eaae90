// The descent of a ray through a tree, boxes and triangles eight at a time.
#pragma once

#include <cstdint>
#include <span>

#include "octoblisk/raycast.h"

namespace octoblisk::detail {

/// Receives a triangle that a ray may cross or touch. Returns the greatest t still of interest, or a negative
/// number to stop.
using CandidateVisitor = double (*)(void* context, std::uint32_t triangle);

/// Calls the visitor for every triangle that the ray crosses or touches, and for few others, entering boxes
/// by ascending t, as long as t is of interest. `rounding`: the error of the ray's own points. Ignores
/// cull_back_faces.
void walkRay(const Tree& tree, const Ray& ray, double rounding, CandidateVisitor visitor, void* context);

/// A CandidateVisitor for many rays. It also receives the index of the ray.
using RayCandidateVisitor = double (*)(void* context, std::size_t ray, std::uint32_t triangle);

/// Calls the visitor for the candidates of each ray, in the same order as walkRay with no rounding of the
/// ray's points. Advances several rays in turn: while one waits for memory, the others go on.
void walkRays(const Tree& tree, std::span<const Ray> rays, RayCandidateVisitor visitor, void* context);

/// walkRay for any callable.
template <typename Visit>
void forEachCandidate(const Tree& tree, const Ray& ray, double rounding, Visit visit) {
  walkRay(
      tree, ray, rounding,
      [](void* function, std::uint32_t triangle) { return (*static_cast<Visit*>(function))(triangle); },
      &visit);
}

/// walkRays for any callable.
template <typename Visit>
void forEachCandidate(const Tree& tree, std::span<const Ray> rays, Visit visit) {
  walkRays(
      tree, rays,
      [](void* function, std::size_t ray, std::uint32_t triangle) {
        return (*static_cast<Visit*>(function))(ray, triangle);
      },
      &visit);
}

}  // namespace octoblisk::detail
