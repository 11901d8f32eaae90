// Toolpaths of the belt along a side or an edge of a blade.
#pragma once

#include <vector>

#include "models/belt_grinder.h"
#include "models/blade_contours.h"
#include "models/blade_region.h"
#include "toolpath/path_arm.h"
#include "toolpath/tool_motion.h"
#include "toolpath/wheel_seat.h"

namespace octoblisk::demos {

/// Longitudinal passes run along the blade's length, root to tip; transversal passes run along its chord, or
/// around the edge if that is ground.
enum class PathPattern { longitudinal, transversal };

/// Lengths in mm, angles in degrees.
struct SurfacePathOptions {
  BladeRegion region = BladeRegion::forward;
  PathPattern pattern = PathPattern::transversal;
  PathArm arm = PathArm::outward;  ///< the direction in which the arm leaves the blades
  double step_over = 5.0;          ///< greatest distance from pass to pass, along the surface
  double tilt = 8.0;           ///< of the arm, off the surface, about the contact wheel's axis; within ±90
  double lead = 0.0;           ///< of the arm, in the surface, towards the trailing edge; within ±90
  double feed = 1000.0;        ///< mm/min
  double pose_step = 2.0;      ///< greatest distance from contact to contact in a pass
  double greatest_turn = 5.0;  ///< of the surface's normal from contact to contact
  double height_from = 0.45;   ///< fraction of the blade's length: root 0, tip 1
  double height_to = 0.97;
  double edge_margin = 5.0;        ///< width left out along a side's leading and trailing edge
  double edge_reach = kEdgeReach;  ///< reach of the passes to either side of an edge, along the surface
  double depth = 0.02;             ///< to which the belt is pressed into the surface
  double wheel_radius =
      BeltParameters{}.contact_wheel_radius + BeltParameters{}.thickness;  ///< with the belt
  double retract = 60.0;  ///< length of the rapid approach and retraction, along the arm
};

struct SurfacePath {
  std::vector<ToolMotion> motions;
  std::vector<int> pass_of_motion;  ///< counted from 0; -1 for approach, links and retraction
};

/// Passes back and forth over the region at equal steps, as few as keep the step-over everywhere, with links
/// along the surface. A rapid approach comes before them and a rapid retraction after them.
///
/// A pose touches one point p of the blade's surface. Let n be the normal there, outward and smooth over the
/// vertices, a₀ the direction of `arm` in the tangent plane, and s = a₀ × n, which points downstream if the
/// arm leads outward. Then
///   a = cos(lead) a₀ + sin(lead) s,  x = cos(tilt) a + sin(tilt) n (the arm),  z = a × n (the wheel's axis),
///   origin = p + (R − depth) n,
/// On the convex or concave side, the sign of s is chosen so that s leads to the trailing edge; on an
/// edge it stays as it is. Poses are in the contours' frame, whose Z is the blisk's axis. With a
/// seat, they are then shifted along n until the wheel, at its full width, is no deeper in the blade than the
/// depth: on a hollow side a wide wheel would cut with its edges.
///
/// Throws std::invalid_argument with a one-line message: an option out of range, margins that leave nothing,
/// more than 1,000,000 passes or poses.
SurfacePath makeSurfacePath(const BladeContours& blade, const SurfacePathOptions& options,
                            const WheelSeat* seat = nullptr);

}  // namespace octoblisk::demos
