#include "paper/robot/robot_noise.h"

namespace octoblisk::demos {

RobotNoise::RobotNoise(const NoiseOptions& options) : options_(options), random_(options.seed) {
  const Vec3 turn = options.direction * draw3();
  tool_error_.translation = options.position * draw3();
  if (turn.norm() > 0.0) {
    tool_error_.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
}

Joints RobotNoise::encoderError() {
  Joints error;
  for (double& joint : error) joint = options_.encoder * normal_(random_);
  return error;
}

Vec3 RobotNoise::draw3() {
  Vec3 drawn;
  for (double& each : drawn) each = normal_(random_);
  return drawn;
}

}  // namespace octoblisk::demos
