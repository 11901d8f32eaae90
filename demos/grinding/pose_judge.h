// Whether the grinder may be at a pose at all: as octoblisk grind judges it, but ended by the first hit.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "grinding/grinding_cell.h"
#include "octoblisk/depth.h"
#include "octoblisk/path_query.h"

namespace octoblisk::demos {

struct ReachRules {
  std::size_t grinding_part = 0;  ///< the part that may touch: the belt
  int ground_blade = 1;           ///< the blade that it may touch; 0: none
  double max_depth = 0.1;         ///< mm that it may be pressed into it
  double margin = 0.0;            ///< mm that every other pair must keep; 0: they must not touch
};

/// What is in the way of a pose.
struct Hindrance {
  std::size_t part = 0;    ///< of the tool
  int blade = 0;           ///< 0: hub or shroud
  bool too_deep = false;   ///< the belt in the blade that it grinds
  bool is_inside = false;  ///< the part is wholly in the blisk, or the blisk in the part
};

struct PoseState {
  std::optional<Hindrance> obstacle;  ///< none: the pose is free
  bool grinds = false;                ///< a free pose's belt touches the blade that it grinds
};

/// The blisk, parted into the ground blade and the rest, and the tool. A pose is free where no part touches
/// the blisk, comes nearer than the margin or lies in it, but for the belt on the ground blade; there the
/// belt may be as deep as PartDepths (part_depths.h) says. Without a margin the free poses are those
/// that octoblisk grind does not call interference.
class PoseJudge {
 public:
  /// `threads` as in parallelFor's threadCount. Throws std::invalid_argument where the blades' numbers are
  /// not those of the blisk's mesh.
  PoseJudge(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
            std::vector<int> blade_of_triangle, const ReachRules& rules, int threads = 0);
  ~PoseJudge();
  PoseJudge(const PoseJudge&) = delete;
  PoseJudge& operator=(const PoseJudge&) = delete;

  /// The states of poses in the blisk's frame; the same for any number of threads. Soonest where each pose is
  /// near the one before. Which of several obstacles is named may depend on the poses before.
  std::vector<PoseState> judge(std::span<const Pose> tool_in_blisk);

  const ClusteredOctree& blisk() const { return *blisk_; }
  const std::vector<ToolPart>& parts() const { return parts_; }
  const ReachRules& rules() const { return rules_; }
  int threads() const;
  int bladeOf(std::uint32_t triangle) const { return blade_of_triangle_[triangle]; }

  /// The triangles of the blisk that a part must keep off: all, or for the belt those of the rest; null where
  /// there are none. `numberInBlisk` tells a triangle's number in the blisk.
  const ClusteredOctree* forbiddenTo(std::size_t part) const;
  std::uint32_t numberInBlisk(std::size_t part, std::uint32_t triangle) const;
  /// Null where no blade is ground.
  const ClusteredOctree* groundBlade() const { return ground_blade_.get(); }

 private:
  struct Trail;   // what is remembered from pose to pose
  struct Worker;  // a thread's memory

  PoseState stateAt(const Pose& pose, Trail& trail, Worker& worker) const;
  std::optional<Hindrance> hitBy(std::size_t part, const Pose& pose, Trail& trail) const;
  bool isInside(std::size_t part, const Pose& pose) const;
  bool isTooDeep(const Pose& pose, std::uint32_t touching_triangle, Trail& trail, Worker& worker) const;
  bool isFineFeatureTooDeep(const Pose& pose, Worker& worker) const;
  bool climbsBeyond(const Pose& pose, std::uint32_t touching_triangle, Trail& trail) const;
  double depthOfCorner(const Pose& pose, std::uint32_t corner) const;

  std::shared_ptr<const ClusteredOctree> blisk_;
  std::vector<ToolPart> parts_;
  std::vector<int> blade_of_triangle_;
  ReachRules rules_;
  octoblisk::Surface blisk_surface_;
  std::vector<octoblisk::Surface> part_surfaces_;
  std::shared_ptr<const ClusteredOctree> ground_blade_, rest_;  // null: no triangles
  std::vector<std::uint32_t> rest_triangles_;                   // their numbers in the blisk
  std::vector<std::uint32_t> fine_triangles_;                   // of a closed blisk: fine_features.h
  std::vector<Worker> workers_;
};

}  // namespace octoblisk::demos
