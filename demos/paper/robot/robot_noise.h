// The errors of an arm's sensors, drawn for each run and each tick.
#pragma once

#include <cstdint>
#include <random>

#include "octoblisk/types.h"
#include "paper/robot/six_axis_arm.h"

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

/// The sequence is the same for the same seed.
class RobotNoise {
 public:
  explicit RobotNoise(const NoiseOptions& options);

  const Pose& toolError() const { return tool_error_; }  ///< of the whole run
  Joints encoderError();                                 ///< of the next tick

 private:
  Vec3 draw3();

  NoiseOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose tool_error_;
};

}  // namespace octoblisk::demos
