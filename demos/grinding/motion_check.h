// Checks the motions between the poses of a path.
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

/// The smallest clearance that a motion can be asked to keep, mm; grind asks for this one.
inline constexpr double kMotionTolerance = 1e-3;

/// If a part that may touch is not proved to stay within its depth limit (depth_proof.h), its depth is
/// measured at places at most this far apart, mm, along the path of the points that may touch; and closer,
/// until the bound of its depth is at most 1.1 times the greatest depth measured on the motion, or the limit.
inline constexpr double kDepthStep = 0.125;

class MotionCheck {
 public:
  /// All arguments must outlive it. `depths` must be for the same parts.
  MotionCheck(std::shared_ptr<const ClusteredOctree> blisk, std::span<const ToolPart> parts,
              const VerdictRules& rules, const Obstacles& obstacles, PartDepths& depths, int threads);

  /// Checks the motions to some poses (`led_to`, ascending, above 0), each from the previous pose. The poses
  /// need the depths of the parts that may touch; their clearances save work.
  /// Conservative advancement (octoblisk/sweep.h) finds what the motion touches and neither of its poses
  /// does: the tool passes through nothing, and a distance below `clearance` (mm, >= kMotionTolerance) is a
  /// hit. The check also proves that the parts that may touch stay within their depth limits. If it cannot
  /// prove this for the whole motion, it measures the depth in the middle and checks each half. The depth is
  /// bounded by the same proof for a greater limit, or by the depths at two places and half of the path
  /// length between them. The answers do not depend on the number of threads.
  std::vector<MotionReport> check(std::span<const PoseReport> poses, std::span<const std::size_t> led_to,
                                  double clearance);

 private:
  struct DepthHere;
  struct DepthBound;
  struct Stretch;
  /// Triangles of a part that may touch, without those near the tool's origin, which turns move little.
  struct FarPart {
    std::shared_ptr<const ClusteredOctree> tree;  ///< null if no triangle is near, or none is far
    double near_radius = 0.0;                     ///< of all other triangles about the origin
  };

  static FarPart farPartOf(const TriangleMesh& part);
  double lengthOfTouch(std::size_t part, const Motion& motion) const;
  void sweepMotion(const PoseReport& from, const PoseReport& to, double clearance,
                   MotionReport& report) const;
  std::vector<Stretch> stretchesOf(const PoseReport& from, const PoseReport& to, MotionReport& report) const;
  std::optional<DepthBound> boundOf(Stretch& stretch) const;
  void halve(std::vector<Stretch>& open);
  const PartDepth* depthInBlisk(const PoseReport& pose, std::size_t part) const;
  DepthHere depthHere(const PartDepth& depth) const;
  void noteUnproved(const Stretch& stretch) const;
  void noteTooDeep(std::size_t part, double fraction, const PartDepth& depth, MotionReport& report) const;

  std::shared_ptr<const ClusteredOctree> blisk_;
  std::span<const ToolPart> parts_;
  const VerdictRules& rules_;
  const Obstacles& obstacles_;
  PartDepths& depths_;
  std::vector<FarPart> far_parts_;  // per part
  // Per part that may touch, if the blisk has no defects.
  std::vector<std::optional<DepthProof>> depth_proofs_;
  int threads_;
};

}  // namespace octoblisk::demos
