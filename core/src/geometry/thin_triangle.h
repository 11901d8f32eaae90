// Which triangles are too thin for their normals.
#pragma once

#include <algorithm>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Whether a triangle is degenerate, or so thin that rounding tilts its normal. The arguments are the squared
/// lengths of scaledNormal(triangle) and of the longest edge.
inline bool isThin(double squared_normal, double squared_longest) {
  constexpr double kThin = 1e-6;  // height over the longest edge
  return !(squared_normal > kThin * kThin * squared_longest * squared_longest);
}

inline double squaredLongestEdge(const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

inline bool isThin(const Triangle& triangle) {
  return isThin(scaledNormal(triangle).squaredNorm(), squaredLongestEdge(triangle));
}

}  // namespace octoblisk::detail
