// How far the tool's parts are from what they must not touch, pose by pose.
#pragma once

#include <span>

#include "grinding/obstacles.h"
#include "grinding/verdict.h"
#include "octoblisk/motion.h"

namespace octoblisk::demos {

/// The move from one pose to another: the tool's origin goes straight, while the tool turns evenly about it.
Motion moveBetween(const Pose& from, const Pose& to);

/// Sets `clearance` of the poses, and `part_clearances` so far as the moves to and from them need them, over
/// threads; the answers do not depend on their number. The neighbours are the poses before the first and
/// after the last, null where there are none.
void measureClearances(const Obstacles& obstacles, std::span<const ToolPart> parts,
                       std::span<PoseReport> poses, const Pose* before, const Pose* after, int threads);

}  // namespace octoblisk::demos
