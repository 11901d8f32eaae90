// Whether the half-line from a point along +x crosses a triangle: exact, and never undecided.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

enum class Crossing { none, crossed, on_triangle };

/// The verdict equals exact arithmetic on the given doubles. `on_triangle` where the closed triangle holds
/// the point. Otherwise the half-line is moved aside by (0, ε², ε) for an ε > 0 smaller than any number
/// (simulation of simplicity: H. Edelsbrunner, E. P. Mücke, 1990): it meets no edge and no vertex then, and
/// crosses the triangles of a closed surface an odd number of times if and only if the point is inside.
Crossing halfLineCrossing(const Vec3& point, const Triangle& triangle);

}  // namespace octoblisk::detail
