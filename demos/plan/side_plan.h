// Plans a path that grinds as much of a side or an edge of a blade as the tool can reach.
#pragma once

#include <cstddef>
#include <vector>

#include "grinding/coverage.h"
#include "grinding/judge.h"
#include "grinding/run_watch.h"
#include "models/side_grid.h"
#include "plan/tool_posture.h"
#include "toolpath/wheel_seat.h"

namespace octoblisk::demos {

/// Lengths in mm.
struct PlanOptions {
  double depth = 0.08;        ///< to which the belt is pressed into the surface
  double scallop = 0.04;      ///< greatest height of the ridges between passes
  double chord_error = 0.01;  ///< greatest distance of a motion between two contacts from the surface
  int threads = 0;            ///< as in parallelFor; the plan does not depend on it
};

/// The passes of the tool in one posture.
struct PlannedSetup {
  ToolPosture posture;
  std::size_t runs = 0, poses = 0;
  double ground = 0.0;  ///< the share of the side's area that is left before and that this one grinds
};

/// A part of the side that the tool cannot reach, and the obstacle of most postures there.
struct UnreachedArea {
  Obstruction obstacle;
  double share = 0.0;  ///< of the side's area
};

struct SidePlan {
  std::vector<Pose> path;                ///< the tool in the blisk's mesh, from home to home
  std::vector<bool> grinds;              ///< per pose: whether it is a contact; the others are links
  std::vector<PlannedSetup> setups;      ///< in the order of the path
  std::vector<GroundPoint> points;       ///< per cell of the grid, with what earlier tools have ground
  std::vector<UnreachedArea> unreached;  ///< the largest first
  bool is_partial = false;               ///< stopped: more might be ground
};

/// What earlier tools have ground: per cell of the grid, with poses counted through their paths in order.
struct GroundBefore {
  std::vector<GroundPoint> points;  ///< empty: nothing
  std::size_t poses = 0;            ///< of all those paths
};

/// Makes one setup after another, each in the posture that grinds most of what is left: the judge finds the
/// cells that the belt grinds there, passes cover these, and links join the passes. Each setup begins and
/// ends at home. The plan ends when no posture grinds a five-hundredth of the side. The judge proves all
/// poses and motions free.
///
/// `grid` is in the frame that `mesh_in_blisk` leads to. The seat is for the judge's blisk, in the frame of
/// its mesh, and for the wheel of the grinding part (wheelOf).
SidePlan planSide(Judge& judge, const SideGrid& grid, const Pose& mesh_in_blisk, const WheelSeat& seat,
                  const PlanOptions& options, const GroundBefore& before = {}, const RunWatch& watch = {});

/// The contact wheel with its belt; lengths in mm.
struct WheelSize {
  double radius = 0.0, width = 0.0;
};

/// The wheel of a belt in the frame of belt_grinder.h: its reach towards -x, and its width along z.
WheelSize wheelOf(const ClusteredOctree& belt);

}  // namespace octoblisk::demos
