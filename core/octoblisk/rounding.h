// How far numbers may be off, as parts of the lengths that enter them: what every search is widened by, so
// that nothing is missed.
#pragma once

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

/// In single precision: 64 units in the last place.
inline constexpr double kSingleRounding = 0x1p-18;

/// Of a vertex posed in double precision: 16 units in the last place.
inline constexpr double kDoubleRounding = 0x1p-48;

/// Of poses on a motion, and of distances between posed triangles.
inline constexpr double kDistanceRounding = 1e-12;

/// The lengths that enter what is measured between two trees, but for those of poses.
inline double sizeOf(const ClusteredOctree& a, const ClusteredOctree& b) {
  return a.origin().norm() + a.radius() + b.origin().norm() + b.radius();
}

}  // namespace octoblisk
