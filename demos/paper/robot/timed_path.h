// A path of poses as a motion: where the tool is to be at a time.
#pragma once

#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// From pose to pose straight on, turning evenly, at constant speed, without a stop between.
class TimedPath {
 public:
  /// `speed` (mm/s) of the poses' origin, or slower where it would turn faster than `turn_rate` (rad/s).
  /// Throws std::invalid_argument for no poses, or a speed or rate not above 0.
  TimedPath(std::vector<Pose> poses, double speed, double turn_rate);

  const std::vector<Pose>& poses() const { return poses_; }
  double duration() const { return times_.back(); }  ///< seconds

  /// At a time in seconds from the first pose; before it the first pose, after the end the last.
  Pose at(double time) const;

 private:
  std::vector<Pose> poses_;
  std::vector<double> times_;  // of the poses
};

}  // namespace octoblisk::demos
