// A six-axis industrial arm with a spherical wrist: dimensions, joint limits, frames of its links, and
// inverse kinematics.
//
// Lengths in mm, angles in radians. The base frame is on the floor: z up, x to the front.
#pragma once

#include <array>

#include "octoblisk/types.h"

namespace octoblisk::demos {

using Joints = Eigen::Matrix<double, 6, 1>;

/// The same in degrees.
Joints jointsOfDegrees(double joint1, double joint2, double joint3, double joint4, double joint5,
                       double joint6);

/// The arm's dimensions. All are assumed, because the paper names no robot: round numbers typical of an
/// industrial arm for about 60 kg with 2 m of reach. With all joints at zero the upper arm is upright, and
/// forearm and tool point to the front.
struct SixAxisArm {
  double shoulder_height = 500.0;  ///< of axis 2 above the floor
  double shoulder_offset = 175.0;  ///< of axis 2 from axis 1
  double upper_arm = 900.0;        ///< from axis 2 to axis 3
  double elbow_offset = 175.0;     ///< of axis 4 from axis 3
  double forearm = 960.0;          ///< from axis 3 to the wrist's centre, along axis 4
  double flange = 135.0;           ///< from the wrist's centre, along axis 6
  Joints least = jointsOfDegrees(-180.0, -90.0, -180.0, -200.0, -125.0, -400.0);
  Joints greatest = jointsOfDegrees(180.0, 150.0, 75.0, 200.0, 125.0, 400.0);
};

/// A joint after J. Denavit and R. S. Hartenberg (1955), in the standard form: frame i is frame i − 1 times
/// Rot_z(joint + offset) · Trans_z(d) · Trans_x(a) · Rot_x(alpha).
struct DhRow {
  double offset, d, a, alpha;
};
std::array<DhRow, 6> dhRows(const SixAxisArm& arm);

/// Frame i in frame i − 1.
Pose dhStep(const DhRow& row, double joint);

/// Frames 1 to 6 in the base frame; the last is the flange, with its z pointing out of it.
std::array<Pose, 6> linkFrames(const SixAxisArm& arm, const Joints& joints);

Pose flangeAt(const SixAxisArm& arm, const Joints& joints);

bool withinLimits(const SixAxisArm& arm, const Joints& joints);

// The joints that bring the flange to a pose, in closed form: axes 4 to 6 meet in the wrist's centre, so the
// first three joints determine its position, and the last three turn the flange (D. L. Pieper, The Kinematics
// of Manipulators under Computer Control, 1968).

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
