// A run of the grinder along a path: the findings at its poses and between them.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grinding/judge.h"
#include "grinding/run_watch.h"
#include "grinding/spindle_cell.h"
#include "models/blade_finder.h"
#include "models/blade_surface.h"
#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// The request for a run.
struct GrindingJob {
  std::shared_ptr<const ClusteredOctree> blisk;  ///< faces outward
  BladesFound blades;                            ///< of the blisk's mesh
  Pose mesh_in_blisk;  ///< from the mesh's frame to the frame whose Z is the blisk's axis
  std::vector<ToolPart> parts;
  std::vector<Fixture> fixtures = {};
  VerdictRules rules;  ///< the ground blade is found if `find_ground_blade`; near_miss must be finite
  /// Takes the blade that the grinding part touches at most poses; there must be a grinding part.
  bool find_ground_blade = false;
  std::vector<Pose> path;                 ///< at least one pose
  bool continuous = true;                 ///< whether to check motions
  std::optional<SpindleOptions> spindle;  ///< set to compute forces
  std::shared_ptr<PartDepths> depths;     ///< shared with other runs (judge.h); null: made for this one
  int threads = 0;  ///< 0: as many as the machine runs at once; the answers do not depend on it
};

/// A finished run, as input of the reports.
struct GrindingRun {
  GrindingJob job;                               ///< with the ground blade
  std::string blisk_name, tool_name, path_name;  ///< the sources of blisk, tool and path
  std::optional<BladeSide> convex_side;          ///< of the blades; none: unknown
  double tree_seconds = 0.0;                     ///< time to build the blisk's tree; 0: unknown

  std::vector<DepthKind> depth_kinds;  ///< per part
  std::vector<PoseReport> poses;       ///< the poses that were done: the first ones of the path
  std::vector<std::optional<SpindleLoad>>
      loads;            ///< if forces were asked for: per pose, by the grinding part
  JudgeTimes per_pose;  ///< means over all threads

  /// "forward" or "backward" (blade_side.h) for a touched triangle of a blade; empty for hub, shroud and
  /// fixtures.
  std::string sideOf(const Touch& touch) const;
  /// The same side as "convex" or "concave" if the run knows which is which.
  std::string faceOf(const Touch& touch) const;
  BodyNames names() const { return BodyNames(job.blades.count, job.fixtures); }
  bool isPartial() const { return poses.size() < job.path.size(); }
  std::size_t count(Verdict verdict) const;                ///< number of poses
  std::size_t count(MotionReport::Outcome outcome) const;  ///< number of motions
  std::size_t motionCount() const;                         ///< number of checked motions
  std::size_t depthsProved()
      const;                  ///< number of motions on which no part is proved to exceed its depth limit
  double depthBound() const;  ///< mm: an upper bound of the depth on all motions
  /// Whether a pose or a motion interferes, or a motion is not proved free.
  bool interferes() const;
};

/// Runs the job: poses with their touches (reduced by reduceContacts), verdicts, depths, clearances and
/// motions. If stopped, the run has the poses finished until then. The caller sets the names.
GrindingRun runGrinding(GrindingJob job, const RunWatch& watch = {});

/// The blade that the belt touches at most poses of a path; the lowest of several, 0 if it touches none;
/// nothing if the watch stopped the search. The answer does not depend on the number of threads.
std::optional<int> bladeTouchedMost(const ClusteredOctree& blisk, const ClusteredOctree& belt,
                                    std::span<const int> blade_of_triangle, std::span<const Pose> path,
                                    int threads = 0, const RunWatch& watch = {});

}  // namespace octoblisk::demos
