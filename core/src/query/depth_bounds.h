// Upper bounds of a distance over a convex part: what depth.cpp prunes with.
//
// The distance to a triangle is convex: over the hull of some points it is below what is interpolated between
// them. So is the distance to the nearest of several triangles below every weighted mean of those
// interpolations.
#pragma once

#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Appends the corners of a polygon that holds what two triangles share: the first, clipped to a thin prism
/// round the second. The prism is thick enough that rounding loses nothing.
void appendCut(const Triangle& of, const Triangle& by, std::vector<Vec3>& corners);

/// The greatest entry of a weighted mean of two rows of equal length, with the weights that make it least, or
/// nearly so.
double leastMean(std::span<const double> first, std::span<const double> second);

/// The greatest entry of that weighted mean of three rows of three whose entries are all equal; infinite
/// where there is none.
double levelMean(std::span<const double> a, std::span<const double> b, std::span<const double> c);

}  // namespace octoblisk::detail
