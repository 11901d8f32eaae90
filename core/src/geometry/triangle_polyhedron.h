// A triangle and a convex polyhedron: separating axes (S. Gottschalk, 1996; D. Gregorius, The Separating Axis
// Test between Convex Polyhedra, GDC 2013).
#pragma once

#include <span>

#include "geometry/marginless_contact.h"
#include "octoblisk/hull_faces.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

struct AxisSearch {
  enum class Verdict {
    beyond_limit,  ///< proved farther apart than the limit
    contact,       ///< `contact` is exact
    apart,  ///< apart, by `contact.distance` or more: no face, nor pair of edges, holds the closest points
  };
  Verdict verdict = Verdict::beyond_limit;
  MarginlessContact contact;
};

/// The triangle is wide enough to have a normal. `faces` are those of the hull of `points`, kMostPoints or
/// fewer (hull_faces.h). Where triangle and hull meet, the distance is minus the length of the shortest
/// translation that parts them; where they lie flat on each other, the points are in the middle of what they
/// share.
AxisSearch searchAxes(const Triangle& triangle, std::span<const Vec3> points, const HullFaces& faces,
                      double limit);

}  // namespace octoblisk::detail
