// How the half-line from a point along +x crosses a triangle. Exact and always decided.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// `leaving`: the half-line passes from the back of the triangle to its front. `entering`: the other way.
enum class Crossing { none, leaving, entering, on_triangle };

/// The verdict equals exact arithmetic on the given doubles. It is `on_triangle` if the closed triangle
/// contains the point. Otherwise the half-line is moved by (0, ε², ε) for an infinitesimal ε > 0 (simulation
/// of simplicity: H. Edelsbrunner, E. P. Mücke, 1990). It then meets no edge and no vertex. Over the
/// triangles of a surface without open edges, the number of times it leaves minus the number of times it
/// enters is the winding number of the point.
Crossing halfLineCrossing(const Vec3& point, const Triangle& triangle);

/// The same for triangles that no point counts as on: +1 if the half-line leaves, -1 if it enters, otherwise
/// 0. A point in the triangle's plane is on the side given by sideInPlane.
int signedCrossing(const Vec3& point, const Triangle& triangle);

/// On which side of a plane a point of the plane counts: +1 for the front, -1 for the back.
int sideInPlane(const Vec3& normal);

}  // namespace octoblisk::detail
