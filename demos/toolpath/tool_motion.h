// One pose of a toolpath with its feed.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// A pose that the tool moves to, and the feed of that motion.
struct ToolMotion {
  Pose tool_in_blisk;
  double feed = 0.0;  ///< mm/min; 0: rapid, or not given
};

}  // namespace octoblisk::demos
