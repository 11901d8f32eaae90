// The descent of a ray through a tree, boxes and triangles eight at a time.
#pragma once

#include <limits>

#include "octoblisk/raycast.h"

namespace octoblisk::detail {

/// A hit with the data that the descent knows.
struct RayCrossing {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoTriangle;
  bool back_face = false;
};

/// Receives a crossing and returns the greatest t still of interest, or a negative number to stop.
using CrossingVisitor = double (*)(void* context, const RayCrossing& crossing);

/// Calls the visitor for every triangle that the ray crosses, entering boxes by ascending t, as long as t is
/// of interest.
void walkRay(const Tree& tree, const Ray& ray, CrossingVisitor visitor, void* context);

}  // namespace octoblisk::detail
