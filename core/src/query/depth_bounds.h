// Upper bounds of a distance over a convex part, with which DepthQuery prunes its search.
//
// The distance to a triangle is convex. Over the hull of some points it is therefore at most the
// interpolation between its values at these points. The distance to the nearest of several triangles is at
// most every weighted mean of these interpolations.
#pragma once

#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Appends the corners of a polygon that contains the intersection of two triangles: the first triangle,
/// clipped to a thin prism around the second. The prism is thick enough that rounding loses nothing.
void appendCut(const Triangle& of, const Triangle& by, std::vector<Vec3>& corners);

/// The largest entry of the weighted mean of two rows of equal length, for the weights that make this entry
/// smallest, or nearly so.
double leastMean(std::span<const double> first, std::span<const double> second);

/// The entry of the weighted mean of three rows of three, for weights that make its entries equal; infinite
/// if there are no such weights.
double levelMean(std::span<const double> a, std::span<const double> b, std::span<const double> c);

}  // namespace octoblisk::detail
