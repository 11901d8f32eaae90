// What is before and behind a surface.
#pragma once

#include "octoblisk/surface.h"
#include "query/winding.h"

namespace octoblisk::detail {

/// The winding numbers before and behind a triangle. Caps close the mesh.
struct Sides {
  int front = 0, back = 0;

  TriangleRole role() const {
    if (front != 0 && back != 0) return TriangleRole::inner;
    if (front == 0 && back == 0) return TriangleRole::sheet;
    return front == 0 ? TriangleRole::outward : TriangleRole::inward;
  }
};

/// Those at a point of a surface with a unit normal, at a distance of the tolerance or a little more.
inline Sides sidesOf(const Winding& winding, const Vec3& middle, const Vec3& normal, double tolerance) {
  // A step farther if another part of the surface is exactly there.
  const auto beside = [&](double sign) {
    for (double step = tolerance; step < 16.0 * tolerance; step *= 2.0) {
      if (const auto number = winding.closedAt(middle + sign * step * normal)) return *number;
    }
    return 0;
  };
  return {beside(1.0), beside(-1.0)};
}

}  // namespace octoblisk::detail
