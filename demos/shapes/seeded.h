// Random numbers, points and rotations that are the same on every platform.
#pragma once

#include <random>

#include "octoblisk/types.h"

namespace octoblisk::shapes {

/// A uniform number in [low, high).
double uniform(std::mt19937_64& random, double low, double high);

/// Each coordinate within ±half_size.
Vec3 randomPoint(std::mt19937_64& random, double half_size);

/// A uniform rotation.
Mat3 randomRotation(std::mt19937_64& random);

}  // namespace octoblisk::shapes
