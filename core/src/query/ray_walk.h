// The walk of a ray down a tree, boxes and triangles eight at a time.
#pragma once

#include <limits>

#include "octoblisk/raycast.h"

namespace octoblisk::detail {

/// A hit as far as the walk knows it.
struct RayCrossing {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoTriangle;
  bool back_face = false;
};

/// Is told of a crossing and returns the greatest t still of interest; below 0: none.
using CrossingVisitor = double (*)(void* context, const RayCrossing& crossing);

/// Calls the visitor for every triangle that the ray crosses, boxes entered by ascending t, as long as t is
/// of interest.
void walkRay(const Tree& tree, const Ray& ray, CrossingVisitor visitor, void* context);

}  // namespace octoblisk::detail
