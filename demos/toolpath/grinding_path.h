// A path of the belt grinder over one side of a blade.
#pragma once

#include <vector>

#include "models/belt_grinder.h"
#include "models/blade_finder.h"
#include "octoblisk/triangle_mesh.h"
#include "toolpath/path_arm.h"

namespace octoblisk::demos {

/// Lengths in mm.
struct GrindingPathOptions {
  PathArm arm = PathArm::outward;  ///< the direction in which the arm leaves the blades
  int blade = 1;
  int passes = 6;                ///< along the axis, back and forth
  int poses_per_pass = 60;       ///< equally spaced along the axis
  double lean_degrees = 8.0;     ///< of the arm, away from the surface; within ±90
  double depth = 0.02;           ///< to which the belt is pressed into the surface
  bool forward_side = true;      ///< grind the side that faces towards greater angles about Z
  double clear_of_edges = 0.08;  ///< fraction of the chord left out at each edge, in [0, 0.5)
  double chord_from = 0.0;       ///< first point, as a fraction 0..1 of the remaining chord
  double chord_to = 1.0;         ///< last point
  double span_from = 0.97;       ///< first pass, as a fraction of the blade's height: root 0, tip 1
  double span_to = 0.45;         ///< last pass
  double wheel_radius =
      BeltParameters{}.contact_wheel_radius + BeltParameters{}.thickness;  ///< with the belt
  int retract_poses = 20;  ///< of the approach, and also of the retraction
  double retract = 60.0;   ///< length of each
};

/// The poses belt_in_blisk (belt_grinder.h) in order: retract_poses of approach along the arm, the passes
/// with the links between them, retract_poses of retraction along the arm.
///
/// A working pose touches one point p of the blade's side, found exactly on its triangle. Let n be the
/// outward normal, smoothed over the side's vertices, R the wheel radius and a₀ the direction of `arm` in the
/// tangent plane. Then
///   origin = p + (R − depth) n,  x = cos(lean) a₀ + sin(lean) n (the arm),  z = a₀ × n (the wheels' axis),
/// and so z points downstream if the arm leads outward. Each pass keeps one radius, and each link one
/// fraction of the chord; steps on links are no longer than those on a pass. Poses where the side has no
/// triangle are left out.
///
/// The blade's triangles must all be oriented outwards, or all inwards.
///
/// Throws std::invalid_argument with a one-line message: no blades were found, or none has that number; blade
/// numbers that are not for this mesh; a count not above 0; an option out of range; a side without any point
/// on the path.
std::vector<Pose> makeGrindingPath(const TriangleMesh& blisk, const BladesFound& blades,
                                   const GrindingPathOptions& options = {});

}  // namespace octoblisk::demos
