// The distance of poses of the robot.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// In mm; a turn of a thousandth counts as a millimetre.
inline double apart(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() + 1000.0 * (a.rotation - b.rotation).cwiseAbs().maxCoeff();
}

}  // namespace octoblisk::demos
