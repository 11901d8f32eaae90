// Clearances of the tool's parts from their obstacles, pose by pose.
#pragma once

#include <span>

#include "grinding/obstacles.h"
#include "grinding/verdict.h"
#include "octoblisk/motion.h"

namespace octoblisk::demos {

/// The motion from one pose to another: the tool's origin moves straight, and the tool rotates about it at a
/// constant rate.
Motion motionBetween(const Pose& from, const Pose& to);

/// Sets `clearance` of the poses, and as many `part_clearances` as the motions to and from them need. Poses
/// are measured in parallel; the answers do not depend on the number of threads. The neighbours are the poses
/// before the first and after the last; null if there are none.
void measureClearances(const Obstacles& obstacles, std::span<const ToolPart> parts,
                       std::span<PoseReport> poses, const Pose* before, const Pose* after, int threads);

}  // namespace octoblisk::demos
