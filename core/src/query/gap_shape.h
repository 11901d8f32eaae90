// The shapes of gaps in a mesh.
#pragma once

#include <span>
#include <vector>

#include "octoblisk/inspection.h"
#include "query/solid_parts.h"

namespace octoblisk::detail {

/// The greatest distance from its plane at which a corner of a planar hole may be, relative to the hole's
/// size (closeHoles).
inline constexpr double kPlanar = 1e-4;

/// The corners around a gap, also those that are close to each other. Begins with an edge of the lowest
/// triangle.
std::vector<Vec3> outlineOf(const Gap& gap);

/// All about a gap but its kind and its width.
MeshGap shapeOf(const Gap& gap);

/// Twice the area vector of an outline. It points to where the outline turns left.
Vec3 areaVector(std::span<const Vec3> outline);

/// The corners where the outline does not turn by 90° or more.
std::vector<Vec3> straightCorners(std::span<const Vec3> outline);

/// The width of a narrow gap: the greatest distance to the edges on its other side, of the edges' middles and
/// the straight corners.
double widthOf(std::span<const Vec3> outline);

}  // namespace octoblisk::detail
