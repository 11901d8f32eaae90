// How far numbers may be off, as parts of the lengths that enter them: what every search is widened by, so
// that nothing is missed.
#pragma once

namespace octoblisk::detail {

/// In single precision: 64 units in the last place.
inline constexpr double kSingleRounding = 0x1p-18;

/// Of a vertex posed in double precision: 16 units in the last place.
inline constexpr double kDoubleRounding = 0x1p-48;

/// Of poses on a motion, and of distances between posed triangles.
inline constexpr double kDistanceRounding = 1e-12;

}  // namespace octoblisk::detail
