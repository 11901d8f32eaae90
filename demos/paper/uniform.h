// Random numbers that are the same on every platform.
#pragma once

#include <random>

namespace octoblisk::demos {

/// In [0, 1).
inline double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

}  // namespace octoblisk::demos
