// The options of a run of the robot (Table 4).
#pragma once

#include <cstddef>
#include <cstdint>

#include "build/paper/k_means.h"

namespace octoblisk::demos {

/// The sensors' errors, drawn from normal distributions with these standard deviations.
struct NoiseOptions {
  double encoder = 1e-5;  ///< of each joint at each tick, rad; assumed

  /// Of the tool's position and direction, along and about each axis, for a whole run (mm, rad): a third of
  /// the unidirectional repeatability of an ABB IRB 1600 as measured by M. Slamani, A. Nubiola and I. Bonev
  /// (Industrial Robot 39 (1), 2012).
  double position = 0.037 / 3.0;
  double direction = 87e-6 / 3.0;
  std::uint64_t seed = 1;
};

struct RobotRunOptions {
  double control_period = 0.004;  ///< s: that of ABB's Externally Guided Motion
  double speed = 20.0;            ///< of the contact wheel's centre along the path, mm/s; assumed
  double turn_rate = 0.5;         ///< greatest, rad/s; assumed
  int steps_per_tick = 4;         ///< of the Bullet world
  double margin = 0.2;            ///< mm: the second exact method reports everything within this distance
  int ground_blade = 1;           ///< the blade that the belt may touch
  detail::KMeansOptions k_means;  ///< for each part, in the paper's method
  std::size_t leaf_capacity = 2;  ///< in the paper's octrees (FNOP)
  NoiseOptions noise;
};

}  // namespace octoblisk::demos
