// How far poses of the robot are apart.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// mm, with a turn of a thousandth as a millimetre.
inline double apart(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() + 1000.0 * (a.rotation - b.rotation).cwiseAbs().maxCoeff();
}

}  // namespace octoblisk::demos
