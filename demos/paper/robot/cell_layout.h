// Chooses the position of the blisk beside the arm, and the arm's hold of the grinder, so that a path is
// reached.
#pragma once

#include <vector>

#include "octoblisk/types.h"
#include "paper/robot/six_axis_arm.h"

namespace octoblisk::demos {

/// The blisk's stand: a turntable whose axis is horizontal across the arm's front (along y). All values are
/// assumed; mm.
struct StandOptions {
  Vec3 center{1250.0, 0.0, 550.0};  ///< of the blisk, in the arm's base frame
  int turntable_steps = 72;         ///< number of angles to try, evenly spaced
  double tool_length = 380.0;       ///< from the flange to the contact wheel's centre
};

struct CellLayout {
  Pose blisk_in_base;
  Pose tool_in_flange;
  double turntable_angle = 0.0;  ///< rad
  Joints start;                  ///< at the path's first pose
  double margin = 0.0;           ///< see chooseLayout
};

/// The hold of the grinder: its arm points towards the flange, its wheels' axis is along the flange's y.
Pose toolInFlange(double tool_length);

/// The blisk on its stand at an angle. Its z axis is the turntable's; its point at z = `middle` (mm) is at
/// the centre.
Pose bliskInBase(const StandOptions& stand, double turntable_angle, double middle);

/// Tries the turntable's angles and all branches for the path's first pose, and takes those with the greatest
/// margin: the least distance (rad), along the whole path, of a joint from its limits and of joint 5 from 0,
/// where the wrist is singular. A path on which a joint jumps by more than a quarter turn between poses does
/// not count as reached.
///
/// `tool_in_blisk`: the belt's poses in the blisk's frame; `bounds`: the blisk's, mm. Throws
/// std::invalid_argument if no angle lets the arm reach every pose, with the first pose that it cannot reach
/// at best and the reason; for an empty path; for fewer than one step of the turntable.
CellLayout chooseLayout(const SixAxisArm& arm, const std::vector<Pose>& tool_in_blisk, const Aabb& bounds,
                        const StandOptions& stand = {});

}  // namespace octoblisk::demos
