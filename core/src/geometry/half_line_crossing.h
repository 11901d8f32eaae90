// Whether the half-line from a point along +x crosses a triangle. Exact and always decided.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

enum class Crossing { none, crossed, on_triangle };

/// The verdict equals exact arithmetic on the given doubles. It is `on_triangle` if the closed triangle
/// contains the point. Otherwise the half-line is moved by (0, ε², ε) for an infinitesimal ε > 0 (simulation
/// of simplicity: H. Edelsbrunner, E. P. Mücke, 1990). It then meets no edge and no vertex, and crosses the
/// triangles of a closed surface an odd number of times if and only if the point is inside.
Crossing halfLineCrossing(const Vec3& point, const Triangle& triangle);

}  // namespace octoblisk::detail
