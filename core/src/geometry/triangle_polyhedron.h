// Contacts between a triangle and a convex polyhedron by separating axes (S. Gottschalk, 1996; D. Gregorius,
// The Separating Axis Test between Convex Polyhedra, GDC 2013).
#pragma once

#include <span>

#include "geometry/core_contact.h"
#include "octoblisk/hull_faces.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

struct AxisSearch {
  enum class Verdict {
    beyond_limit,  ///< proved to be farther apart than the limit
    contact,       ///< `contact` is exact
    apart,  ///< apart by at least `contact.distance`: no face or pair of edges contains the closest points
  };
  Verdict verdict = Verdict::beyond_limit;
  CoreContact contact;
};

/// Whether searchAxes can search these faces. It needs at least one face, and has room for a limited number
/// of points, faces and edges.
bool canSearchAxes(std::span<const Vec3> points, const HullFaces& faces);

/// The triangle must be wide enough to have a normal. `faces` are those of the hull of `points`. If triangle
/// and hull meet, the distance is minus the length of the shortest translation that separates them. If they
/// lie flat on each other, the points are in the middle of their common area.
AxisSearch searchAxes(const Triangle& triangle, std::span<const Vec3> points, const HullFaces& faces,
                      double limit);

}  // namespace octoblisk::detail
