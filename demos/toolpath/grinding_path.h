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
  PathArm arm = PathArm::outward;  ///< how the arm leaves the blades
  int blade = 1;
  int passes = 6;                ///< along the axis, there and back
  int poses_per_pass = 60;       ///< equally spaced along the axis
  double lean_degrees = 8.0;     ///< of the arm, away from the surface; within ±90
  double depth = 0.02;           ///< how far the belt is pressed into the surface
  bool forward_side = true;      ///< the side that faces towards greater angles about Z
  double clear_of_edges = 0.08;  ///< part of the chord left out at each edge, in [0, 0.5)
  double chord_from = 0.0;       ///< of what is left, the part 0..1 of the chord to begin at
  double chord_to = 1.0;         ///< and to end at
  double span_from = 0.97;       ///< part of the blade's height, root 0 to tip 1, of the first pass
  double span_to = 0.45;         ///< and of the last
  double wheel_radius =
      BeltParameters{}.contact_wheel_radius + BeltParameters{}.thickness;  ///< with the belt
  int retract_poses = 20;  ///< of the approach, and of the retraction
  double retract = 60.0;   ///< their length
};

/// The poses belt_in_blisk (belt_grinder.h) in their order: retract_poses of approach along the arm, the
/// passes with the links between them, retract_poses of retraction along the arm.
///
/// A working pose touches one point p of the blade's side, found exactly on its triangle. With n the outward
/// normal, smoothed over the side's vertices, R the wheel radius and a₀ the direction of `arm` in the tangent
/// plane,
///   origin = p + (R − depth) n,  x = cos(lean) a₀ + sin(lean) n (the arm),  z = a₀ × n (the wheels' axis),
/// so that z runs along the stream where the arm leads outward. Each pass keeps one radius, and each link one
/// part of the chord; links take steps no longer than those of a pass. Where the side has no triangle, a pose
/// is left out.
///
/// The blade's triangles must be oriented alike, all outwards or all inwards.
///
/// Throws std::invalid_argument in one line: no blades were found, or none has that number; numbers that are
/// not of this mesh; a count not above 0; an option out of its range; a side without a single point.
std::vector<Pose> makeGrindingPath(const TriangleMesh& blisk, const BladesFound& blades,
                                   const GrindingPathOptions& options = {});

}  // namespace octoblisk::demos
