// A run of the grinder along a path: all that is found at its poses and between them.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grinding/run_watch.h"
#include "grinding/spindle_cell.h"
#include "grinding/verdict.h"
#include "models/blade_finder.h"
#include "models/blade_surface.h"

namespace octoblisk::demos {

/// A finished run, as the reports need it.
struct GrindingRun {
  std::string blisk_name, tool_name, path_name;  ///< where they came from
  std::shared_ptr<const ClusteredOctree> blisk;
  std::vector<ToolPart> parts;
  std::vector<DepthKind> depth_kinds;  ///< of each part
  int blade_count = 0;
  std::vector<int> blade_of_triangle;  ///< of the blisk's mesh
  std::vector<Fixture> fixtures;
  Pose mesh_in_blisk;                    ///< from the mesh's frame to that with the blisk's axis Z
  std::optional<BladeSide> convex_side;  ///< of the blades; none: not known
  VerdictRules rules;
  bool continuous = false;                        ///< whether moves were checked
  std::size_t path_poses = 0;                     ///< of the whole path
  std::vector<PoseReport> poses;                  ///< those that were done: the first of the path
  std::optional<SpindleOptions> spindle;          ///< where forces were asked for
  std::vector<std::optional<SpindleLoad>> loads;  ///< of each pose, then; by the grinding part
  double tree_seconds = 0.0;                      ///< to build the blisk's tree; 0: not known
  /// Means of all threads together, s a pose.
  double contact_seconds_a_pose = 0.0;    ///< Bullet's answer which parts are near, and their contacts
  double depth_seconds_a_pose = 0.0;      ///< how deep the parts are
  double clearance_seconds_a_pose = 0.0;  ///< how far they are from what they must not touch
  double move_seconds_a_pose = 0.0;       ///< what happens between the poses

  /// "forward" or "backward" (blade_side.h) of a triangle of a blade; empty of hub, shroud and fixtures.
  std::string sideOf(std::uint32_t triangle, int body) const;
  /// The same side as "convex" or "concave" if the run knows which is which.
  std::string faceOf(std::uint32_t triangle, int body) const;
  BodyNames names() const { return BodyNames(blade_count, fixtures); }
  bool isPartial() const { return poses.size() < path_poses; }
  std::size_t count(Verdict verdict) const;              ///< poses
  std::size_t count(MoveReport::Outcome outcome) const;  ///< moves
  std::size_t moveCount() const;                         ///< that were checked
  std::size_t depthsProved() const;  ///< moves on which what may touch is proved no deeper than it may be
  double depthBound() const;         ///< mm: no deeper on any move
  /// Whether a pose or a move interferes, or a move could not be proved free.
  bool interferes() const;
};

/// What a run is asked.
struct GrindingJob {
  std::shared_ptr<const ClusteredOctree> blisk;  ///< faces outward
  BladesFound blades;                            ///< of its mesh
  Pose mesh_in_blisk;                            ///< from the mesh's frame to that with the blisk's axis Z
  std::vector<ToolPart> parts;
  std::vector<Fixture> fixtures = {};
  VerdictRules rules;  ///< its ground blade is found if `find_ground_blade`; near_miss must be finite
  /// As that which the grinding part touches at the most poses; there must be such a part.
  bool find_ground_blade = false;
  std::vector<Pose> path;                 ///< at least one pose
  bool continuous = true;                 ///< whether moves are checked
  std::optional<SpindleOptions> spindle;  ///< whether forces are found, and by what
  int threads = 0;  ///< 0: as many as the machine runs at once; the answers are the same
};

/// The job done: judged poses with their contacts (as reduceContacts keeps them), depths, clearances and
/// moves. Stopped, it has the poses done by then. The names are left to the caller.
GrindingRun runGrinding(const GrindingJob& job, const RunWatch& watch = {});

}  // namespace octoblisk::demos
