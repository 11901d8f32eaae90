// A path of poses as a motion over time.
#pragma once

#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// Moves straight from pose to pose and rotates at a constant rate, at constant speed, without stops.
class TimedPath {
 public:
  /// `speed` (mm/s) is that of the poses' origin; it is lower where the tool would turn faster than
  /// `turn_rate` (rad/s).
  /// Throws std::invalid_argument for no poses, or a speed or rate not above 0.
  TimedPath(std::vector<Pose> poses, double speed, double turn_rate);

  const std::vector<Pose>& poses() const { return poses_; }
  double duration() const { return times_.back(); }  ///< seconds

  /// At a time in seconds from the first pose; the first pose before it, the last pose after the end.
  Pose at(double time) const;

 private:
  std::vector<Pose> poses_;
  std::vector<double> times_;  // per pose
};

}  // namespace octoblisk::demos
