// What happens between the poses of a path.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "grinding/depth_proof.h"
#include "grinding/obstacles.h"
#include "grinding/part_depths.h"
#include "grinding/verdict.h"
#include "octoblisk/motion.h"

namespace octoblisk::demos {

/// The least clearance that a move may be asked to keep, mm; grind asks for no more.
inline constexpr double kMoveTolerance = 1e-3;

/// Where it is not proved that a part that may touch stays within its depth (depth_proof.h), its depth is
/// measured at places no farther apart than this, mm: the way of the points that may touch. Between two it
/// may be deeper than at both by half of their way: MoveReport::depth_bound.
inline constexpr double kDepthStep = 0.5;

class MoveCheck {
 public:
  /// All must outlive it. `depths`: of the same parts.
  MoveCheck(std::shared_ptr<const ClusteredOctree> blisk, std::span<const ToolPart> parts,
            const VerdictRules& rules, const Obstacles& obstacles, PartDepths& depths, int threads);

  /// What happens on the moves to some poses (`led_to`, ascending, above 0) from the pose before each. The
  /// poses need their depths of the parts that may touch; their clearances (pose_clearances.h) save work.
  /// A move is asked what it touches that neither of its poses does: by conservative advancement
  /// (octoblisk/sweep.h), so nothing is passed through, and what comes as near as `clearance` (mm, >=
  /// kMoveTolerance) is hit. It is also asked whether what may touch stays within its depth. Where that is
  /// not proved of a move as a whole, its depth is measured amid it, and each half is asked again. The
  /// answers do not depend on the number of threads.
  std::vector<MoveReport> check(std::span<const PoseReport> poses, std::span<const std::size_t> led_to,
                                double clearance);

 private:
  struct Touch;
  struct Stretch;
  /// Of a part that may touch: all but what is near the tool's origin, which turns move little.
  struct FarPart {
    std::shared_ptr<const ClusteredOctree> tree;  ///< null where nothing is near, or nothing far
    double near_radius = 0.0;                     ///< of all the rest about the origin
  };

  static FarPart farPartOf(const TriangleMesh& part);
  double wayOfTouch(std::size_t part, const Motion& way) const;
  void sweepMove(const PoseReport& from, const PoseReport& to, double clearance, MoveReport& move) const;
  std::vector<Stretch> stretchesOf(const PoseReport& from, const PoseReport& to, MoveReport& move) const;
  bool isProved(const Stretch& stretch) const;
  void halve(std::vector<Stretch>& unproved);
  Touch touchOf(const PartDepth& depth) const;
  void noteTooDeep(std::size_t part, double fraction, const PartDepth& depth, MoveReport& move) const;

  std::shared_ptr<const ClusteredOctree> blisk_;
  std::span<const ToolPart> parts_;
  const VerdictRules& rules_;
  const Obstacles& obstacles_;
  PartDepths& depths_;
  std::vector<FarPart> far_parts_;                       // of each part
  std::vector<std::optional<DepthProof>> depth_proofs_;  // of each part that may touch a whole blisk
  int threads_;
};

}  // namespace octoblisk::demos
