// Toolpaths of the belt along the side or the leading edge of a blade.
#pragma once

#include <vector>

#include "models/belt_grinder.h"
#include "models/blade_contours.h"
#include "models/blade_surface.h"
#include "toolpath/path_arm.h"
#include "toolpath/tool_move.h"
#include "toolpath/wheel_seat.h"

namespace octoblisk::demos {

enum class PathRegion { forward, backward, leading_edge };

/// Longitudinal passes go along the blade's length, root to tip; transversal ones along its chord, round the
/// edge where that is ground.
enum class PathPattern { longitudinal, transversal };

/// Lengths in mm, angles in degrees.
struct SurfacePathOptions {
  PathRegion region = PathRegion::forward;
  PathPattern pattern = PathPattern::transversal;
  PathArm arm = PathArm::outward;  ///< how the arm leaves the blades
  double step_over = 5.0;          ///< greatest distance from pass to pass, along the surface
  double tilt = 8.0;           ///< of the arm, off the surface, about the contact wheel's axis; within ±90
  double lead = 0.0;           ///< of the arm, in the surface, towards the trailing edge; within ±90
  double feed = 1000.0;        ///< mm/min
  double pose_step = 2.0;      ///< greatest distance from contact to contact in a pass
  double greatest_turn = 5.0;  ///< of the surface's normal from contact to contact
  double height_from = 0.45;   ///< part of the blade's length, root 0 to tip 1
  double height_to = 0.97;
  double edge_margin = 5.0;  ///< left out of a side along the leading and the trailing edge
  double edge_reach = 3.0;   ///< leading edge: how far passes reach on either side of it, along the surface
  double depth = 0.02;       ///< how far the belt is pressed into the surface
  double wheel_radius =
      BeltParameters{}.contact_wheel_radius + BeltParameters{}.thickness;  ///< with the belt
  double retract = 60.0;  ///< length of the rapid approach and retraction, along the arm
};

struct SurfacePath {
  std::vector<ToolMove> moves;
  std::vector<int> pass_of_move;  ///< counted from 0; -1 for approach, links between passes and retraction
};

/// Passes there and back over the region at equal steps, as few as keep the step-over everywhere, linked
/// along the surface; before them an approach, after them a retraction, both rapid.
///
/// A pose touches one point p of the blade's surface: with n the normal there, outward and smooth over the
/// vertices, a₀ the direction of `arm` in the tangent plane and s = a₀ × n, which is along the stream for an
/// arm that leads outward,
///   a = cos(lead) a₀ + sin(lead) s,  x = cos(tilt) a + sin(tilt) n (the arm),  z = a × n (the wheel's axis),
///   origin = p + (R − depth) n,
/// s taken so on the convex or concave side that leads to the trailing edge, and on the leading edge as is.
/// Poses are in the contours' frame, whose Z is the blisk's axis. With a seat, they are then shifted along n
/// to where the wheel, as wide as it is, is no deeper in the blade than the depth: on a hollow side a wide
/// wheel would cut with its edges.
///
/// Throws std::invalid_argument in one line: an option out of its range, margins that leave nothing, passes
/// or poses beyond 1,000,000.
SurfacePath makeSurfacePath(const BladeContours& blade, const SurfacePathOptions& options,
                            const WheelSeat* seat = nullptr);

}  // namespace octoblisk::demos
