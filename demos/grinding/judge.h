// The judge: decides whether a pose or a move of the tool is clear, intended, near, gouging or unknown. grind
// asks it in full; access and repair ask only whether the tool may be there.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "grinding/move_check.h"
#include "grinding/obstacles.h"
#include "grinding/part_depths.h"
#include "grinding/verdict.h"

namespace octoblisk::demos {

/// What is in the way of a pose or a move.
struct Hindrance {
  std::size_t part = 0;    ///< of the tool
  int blade = 0;           ///< 0: hub or shroud; beyond the blades: a fixture (BodyNames)
  bool too_deep = false;   ///< in a blade that the part may touch
  bool is_inside = false;  ///< the part is wholly in the blisk or a fixture, or that in the part
};

struct PoseState {
  std::optional<Hindrance> obstacle;  ///< none: the pose is free
  bool grinds = false;                ///< a part touches what it may touch, and nothing else
};

/// A straight move of the tool's origin that turns evenly.
struct Move {
  Pose from, to;
};

class Judge {
 public:
  /// `threads` as in parallelFor's threadCount; no answer depends on their number. Throws
  /// std::invalid_argument if the blades' numbers are not those of the blisk's mesh.
  Judge(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
        std::span<const int> blade_of_triangle, VerdictRules rules, int threads = 0,
        std::span<const Fixture> fixtures = {});
  ~Judge();
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  const ClusteredOctree& blisk() const { return *blisk_; }
  const std::vector<ToolPart>& parts() const { return parts_; }
  const VerdictRules& rules() const { return rules_; }
  const Obstacles& obstacles() const { return obstacles_; }
  /// Of the surroundings' triangles, of which the blisk's are the first.
  std::span<const int> bladeOfTriangle() const { return obstacles_.bodyOfTriangle(); }
  DepthKind depthKind(std::size_t part) const { return depths_.kindOf(part); }

  /// Sets the depths of poses that have their contacts.
  void measureDepths(std::span<PoseReport> poses);
  /// Sets the verdicts of poses that have their contacts and depths.
  void setVerdicts(std::span<PoseReport> poses) const;
  /// Sets the clearances, as measureClearances (pose_clearances.h) does.
  void measureClearances(std::span<PoseReport> poses, const Pose* before, const Pose* after) const;
  /// Sets `move` of all poses but the first: that from the pose before. The poses must have all of the above.
  void checkMoves(std::span<PoseReport> poses);

  /// Which poses are free: those with the verdict clear or intended contact by rules with the same near_miss
  /// for all pairs, which is the margin that the tool must keep. Ended by the first hit; soonest where each
  /// pose is near the one before. The obstacle that is named, of several, may depend on the poses before.
  std::vector<PoseState> statesOf(std::span<const Pose> tool_in_blisk);

  /// For each move between free poses the first obstacle that is in its way, if any. A move is free if it
  /// keeps half of the margin, and kMoveTolerance at least, from all that must not be touched, and no part is
  /// found deeper than it may be: as MoveCheck says.
  std::vector<std::optional<Hindrance>> obstaclesOf(std::span<const Move> moves);

 private:
  struct Trail;  // what is remembered from pose to pose

  PoseState stateAt(const Pose& pose, Trail& trail, std::size_t thread);
  std::optional<Hindrance> hitBy(std::size_t part, const Pose& pose, Trail& trail) const;
  bool isInside(std::size_t part, const Pose& pose) const;
  std::vector<PoseReport> endsOf(std::span<const Move> moves, std::vector<std::size_t>& led_to);

  std::shared_ptr<const ClusteredOctree> blisk_;
  std::vector<ToolPart> parts_;
  VerdictRules rules_;
  int threads_;
  Obstacles obstacles_;
  PartDepths depths_;
  MoveCheck moves_;
};

}  // namespace octoblisk::demos
