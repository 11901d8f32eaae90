// Converts degrees to radians.
#pragma once

#include <numbers>

namespace octoblisk::demos {

inline double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

}  // namespace octoblisk::demos
