#include "grinding/pose_clearances.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"
#include "octoblisk/batch.h"
#include "octoblisk/path_query.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// Clearances are measured up to this multiple of a motion's path length, so that they can prove the motion
/// free; the excess over 1 covers rounding.
constexpr double kOfMotion = 1.001;

/// Measures one pose after another, each starting from the last.
class ClearanceQuery {
 public:
  ClearanceQuery(const Obstacles& obstacles, std::span<const ToolPart> parts)
      : obstacles_(obstacles), parts_(parts) {
    for (std::size_t part = 0; part < parts.size(); ++part) {
      const Obstacle* const obstacle = obstacles.of(part);
      queries_.push_back(obstacle
                             ? std::optional<PathQuery>(std::in_place, obstacle->tree(), *parts[part].tree)
                             : std::nullopt);
    }
  }

  /// The neighbours are the poses before and after; the pose itself if it has none.
  void ask(const Pose& before, PoseReport& pose, const Pose& after) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    const Motion there = motionBetween(before, pose.tool_in_blisk),
                 on = motionBetween(pose.tool_in_blisk, after);
    pose.part_clearances.assign(parts_.size(), kFar);
    pose.clearance.reset();
    double least = kFar;
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      if (!queries_[part]) continue;
      const ClusteredOctree& tree = *parts_[part].tree;
      const double of_motions = kOfMotion * std::max(there.lengthBound(tree), on.lengthBound(tree));
      Clearance found =
          queries_[part]->distance(pose.tool_in_blisk, {.upper_bound = std::max(least, of_motions)});
      pose.part_clearances[part] = found.distance;
      if (!found.found() || found.distance >= least) continue;
      least = found.distance;
      found.triangle_a = obstacles_.of(part)->triangleOfAll(found.triangle_a);
      pose.clearance = PartClearance{part, obstacles_.bodyOfTriangle()[found.triangle_a], found};
    }
  }

 private:
  const Obstacles& obstacles_;
  std::span<const ToolPart> parts_;
  std::vector<std::optional<PathQuery>> queries_;  // per part
};

}  // namespace

Motion motionBetween(const Pose& from, const Pose& to) { return Motion(from, to); }

void measureClearances(const Obstacles& obstacles, std::span<const ToolPart> parts,
                       std::span<PoseReport> poses, const Pose* before, const Pose* after, int threads) {
  parallelForChunks(poses.size(), kPosesAtOnce, threads, [&](std::size_t begin, std::size_t end) {
    ClearanceQuery query(obstacles, parts);
    for (std::size_t i = begin; i < end; ++i) {
      const Pose& here = poses[i].tool_in_blisk;
      const Pose& last = i > 0 ? poses[i - 1].tool_in_blisk : before ? *before : here;
      const Pose& next = i + 1 < poses.size() ? poses[i + 1].tool_in_blisk : after ? *after : here;
      query.ask(last, poses[i], next);
    }
  });
}

}  // namespace octoblisk::demos
