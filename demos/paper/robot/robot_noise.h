// The errors of an arm's sensors, drawn for each run and each tick.
#pragma once

#include <random>

#include "octoblisk/types.h"
#include "paper/robot/robot_options.h"
#include "paper/robot/six_axis_arm.h"

namespace octoblisk::demos {

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
