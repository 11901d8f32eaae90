// The judge: decides whether a pose or a motion of the tool is clear, intended, near, gouging or unknown.
// grind asks for the full report; access and repair only ask whether the pose is free.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "grinding/grinding_cell.h"
#include "grinding/motion_check.h"
#include "grinding/obstacles.h"
#include "grinding/part_depths.h"
#include "grinding/verdict.h"
#include "octoblisk/path_query.h"

namespace octoblisk::demos {

/// The obstacle that blocks a pose or a motion.
struct Obstruction {
  std::size_t part = 0;    ///< the tool's part
  int blade = 0;           ///< 0: hub or shroud; above the number of blades: a fixture (BodyNames)
  bool too_deep = false;   ///< the part is too deep in a blade that it may touch
  bool is_inside = false;  ///< one of the two lies wholly inside the other
};

struct PoseState {
  std::optional<Obstruction> obstacle;  ///< empty: the pose is free
  bool grinds = false;                  ///< a part touches what it may touch, and nothing else
};

/// The two poses of a motion: the tool's origin moves straight, the tool rotates at a constant rate.
struct MotionEnds {
  Pose from, to;
};

/// The time spent on each question about poses, in seconds.
struct JudgeTimes {
  double contacts = 0.0;    ///< Bullet's contacts of near parts
  double depths = 0.0;      ///< the parts' depths
  double clearances = 0.0;  ///< the clearances from obstacles
  double motions = 0.0;     ///< the motions between poses
};

/// The depths that a judge of these rules needs.
std::shared_ptr<PartDepths> depthsUnder(const VerdictRules& rules,
                                        std::shared_ptr<const ClusteredOctree> blisk,
                                        std::vector<ToolPart> parts, int threads = 0,
                                        std::span<const Fixture> fixtures = {});

class Judge {
 public:
  /// `threads` as in parallelFor; no answer depends on their number. Several judges of the same
  /// blisk, parts and fixtures may share `depths`, one after the other, if the limits of all parts that may
  /// touch are the same; null makes them. Throws std::invalid_argument if the blades' numbers are not those
  /// of the blisk's mesh.
  Judge(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
        std::span<const int> blade_of_triangle, VerdictRules rules, int threads = 0,
        std::span<const Fixture> fixtures = {}, std::shared_ptr<PartDepths> depths = nullptr);
  ~Judge();
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  const ClusteredOctree& blisk() const { return *blisk_; }
  const std::vector<ToolPart>& parts() const { return parts_; }
  const VerdictRules& rules() const { return rules_; }
  int threads() const { return threads_; }
  const Obstacles& obstacles() const { return obstacles_; }
  /// The body of each triangle of the surroundings. The blisk's triangles come first.
  std::span<const int> bodyOfTriangle() const { return obstacles_.bodyOfTriangle(); }
  DepthKind depthKind(std::size_t part) const { return depths_->kindOf(part); }

  /// Judges the next poses of a path, up to `end`, after those that are already judged, and with `motions`
  /// also the motion to each from the pose before. Adds the time spent. near_miss must be finite.
  void judgeNext(std::span<const Pose> path, std::size_t end, bool motions, std::vector<PoseReport>& judged,
                 JudgeTimes& times);

  /// Determines which poses are free: their verdict is clear or intended contact under rules whose near_miss,
  /// the tool's margin, is the same for all pairs. Each pose ends at its first hit; this is fastest if
  /// successive poses are near each other. If several obstacles block a pose, the one named may depend on the
  /// poses before.
  std::vector<PoseState> statesOf(std::span<const Pose> tool_in_blisk);

  /// For each motion between free poses, the first obstacle that blocks it, if any. A motion is free if the
  /// tool keeps half of the margin, and at least kMotionTolerance, from everything that it must not touch,
  /// and MotionCheck finds no part deeper than allowed.
  std::vector<std::optional<Obstruction>> obstaclesOf(std::span<const MotionEnds> motions);

 private:
  struct PoseCache;  // what the previous poses touched

  PoseState stateAt(const Pose& pose, PoseCache& cache, std::size_t thread);
  std::optional<Obstruction> hitBy(std::size_t part, const Pose& pose, PoseCache& cache) const;
  bool isInside(std::size_t part, const Pose& pose) const;
  std::vector<std::optional<PathQuery>> forbiddenQueries() const;
  std::vector<double> reaches() const;
  void findTouches(std::span<PoseReport> poses);
  void measureDepths(std::span<PoseReport> poses);
  void measureClearances(std::span<const Pose> path, std::size_t begin, std::span<PoseReport> poses) const;
  std::vector<PoseReport> endsOf(std::span<const Pose> ends);

  std::shared_ptr<const ClusteredOctree> blisk_;
  std::vector<ToolPart> parts_;
  VerdictRules rules_;
  int threads_;
  Obstacles obstacles_;
  std::shared_ptr<PartDepths> depths_;
  MotionCheck motion_check_;
  int bodies_;                                        // hub, blades and fixtures
  std::vector<std::unique_ptr<GrindingCell>> cells_;  // one per thread, made on first use
};

}  // namespace octoblisk::demos
