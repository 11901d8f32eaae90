// The joints that put a six-axis arm's flange where it is wanted, in closed form.
//
// Axes 4 to 6 meet in the wrist's centre, so the first three joints alone place it and the last three turn
// the flange (D. L. Pieper, The Kinematics of Manipulators under Computer Control, 1968).
#pragma once

#include <array>

#include "paper/robot/six_axis_arm.h"

namespace octoblisk::demos {

enum class Reach {
  reached,
  too_far,        ///< or too near: the two long links cannot span the way to the wrist's centre
  beyond_limits,  ///< the arm could, but for its joints' limits
};

/// "reached", "out of reach", "beyond the joints' limits".
const char* nameOf(Reach reach);

/// The joints, within limits, of the branches that reach a pose.
struct Postures {
  Reach reach = Reach::too_far;  ///< reached where there is one
  std::array<Joints, 8> joints;  ///< turned to face or not, elbow up or down, wrist flipped or not
  int count = 0;
};

/// A joint that may turn round more than once is the turn nearest to `near`. Where axes 4 and 6 are in one
/// line (or the wrist is on axis 1), joint 4 (1) is as `near` it as its limits allow.
Postures posturesFor(const SixAxisArm& arm, const Pose& flange_in_base, const Joints& near);

struct Posture {
  Reach reach = Reach::too_far;
  Joints joints = Joints::Zero();  ///< where it is reached
};

/// Of all branches the one whose joints are nearest to the last ones, by the sum of squares.
Posture inverseKinematics(const SixAxisArm& arm, const Pose& flange_in_base, const Joints& last);

}  // namespace octoblisk::demos
