// One move of a toolpath.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// A pose that the tool goes to, and how fast.
struct ToolMove {
  Pose tool_in_blisk;
  double feed = 0.0;  ///< mm/min; 0: rapid, or not told
};

}  // namespace octoblisk::demos
