// A six-axis industrial arm with a spherical wrist: dimensions, joint limits, and frames of its links.
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

}  // namespace octoblisk::demos
