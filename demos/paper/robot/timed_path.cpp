#include "paper/robot/timed_path.h"

#include <algorithm>
#include <stdexcept>

namespace octoblisk::demos {

TimedPath::TimedPath(std::vector<Pose> poses, double speed, double turn_rate) : poses_(std::move(poses)) {
  if (poses_.empty()) throw std::invalid_argument("the path to follow has no poses");
  if (!(speed > 0.0) || !(turn_rate > 0.0)) {
    throw std::invalid_argument("the speed along a path and its rate of turn must be above 0");
  }
  times_.push_back(0.0);
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    const Pose& from = poses_[i - 1];
    const Pose& to = poses_[i];
    const double length = (to.translation - from.translation).norm();
    const double angle = Eigen::AngleAxisd(from.rotation.transpose() * to.rotation).angle();
    times_.push_back(times_.back() + std::max(length / speed, angle / turn_rate));
  }
}

Pose TimedPath::at(double time) const {
  if (time <= 0.0) return poses_.front();
  if (time >= duration()) return poses_.back();
  const auto after = std::upper_bound(times_.begin(), times_.end(), time);
  const auto index = static_cast<std::size_t>(after - times_.begin());
  const double part = (time - times_[index - 1]) / (times_[index] - times_[index - 1]);
  const Pose& from = poses_[index - 1];
  const Pose& to = poses_[index];
  const Eigen::Quaterniond turned =
      Eigen::Quaterniond(from.rotation).slerp(part, Eigen::Quaterniond(to.rotation));
  return {turned.normalized().toRotationMatrix(),
          from.translation + part * (to.translation - from.translation)};
}

}  // namespace octoblisk::demos
