// The joints that bring a six-axis arm's flange to a pose, in closed form.
//
// Axes 4 to 6 meet in the wrist's centre, so the first three joints determine its position, and the last
// three turn the flange (D. L. Pieper, The Kinematics of Manipulators under Computer Control, 1968).
#pragma once

#include <array>

#include "paper/robot/six_axis_arm.h"

namespace octoblisk::demos {

enum class Reach {
  reached,
  too_far,        ///< or too near: the two long links cannot span the distance to the wrist's centre
  beyond_limits,  ///< the arm could reach it, except for its joints' limits
};

/// "reached", "out of reach", "beyond the joints' limits".
const char* nameOf(Reach reach);

/// The branches that reach a pose, with their joints within limits.
struct Postures {
  Reach reach = Reach::too_far;  ///< reached if there is a branch
  std::array<Joints, 8> joints;  ///< facing or turned away, elbow up or down, wrist flipped or not
  int count = 0;
};

/// A joint that can turn more than once gets the turn nearest to `near`. If axes 4 and 6 are in line (or the
/// wrist is on axis 1), joint 4 (or 1) is as near to `near` as its limits permit.
Postures posturesFor(const SixAxisArm& arm, const Pose& flange_in_base, const Joints& near);

struct Posture {
  Reach reach = Reach::too_far;
  Joints joints = Joints::Zero();  ///< valid if reached
};

/// The branch whose joints are nearest to the last ones, by the sum of squares.
Posture inverseKinematics(const SixAxisArm& arm, const Pose& flange_in_base, const Joints& last);

}  // namespace octoblisk::demos
