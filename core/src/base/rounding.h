// Bounds of rounding errors, relative to the lengths in a computation. Every search is widened by them, so
// that nothing is missed.
#pragma once

namespace octoblisk::detail {

/// Single precision: 64 units in the last place.
inline constexpr double kSingleRounding = 0x1p-18;

/// A vertex posed in double precision: 16 units in the last place.
inline constexpr double kDoubleRounding = 0x1p-48;

/// Poses on a motion, and distances between posed triangles.
inline constexpr double kDistanceRounding = 1e-12;

}  // namespace octoblisk::detail
