// The verdicts of a run compared with FCL.
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <numbers>

#include "grinding/grinding_run.h"
#include "grinding/tool_assembly.h"
#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "shared/fcl_model.h"
#include "shared/solids.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {
namespace {

using testing::FclMesh;
using testing::FclModel;
using testing::fclTransform;

bool touch(const FclModel& blisk, const FclModel& part, const Pose& pose) {
  fcl::CollisionResultd result;
  return fcl::collide<double>(&blisk, fcl::Transform3d::Identity(), &part, fclTransform(pose),
                              fcl::CollisionRequestd(), result) > 0;
}

double distanceOf(const FclModel& blisk, const FclModel& part, const Pose& pose) {
  fcl::DistanceResultd result;
  return fcl::distance<double>(&blisk, fcl::Transform3d::Identity(), &part, fclTransform(pose),
                               fcl::DistanceRequestd(), result);
}

/// The built-in grinder on the built-in blisk's blade 1, without a path.
GrindingJob builtInJob() {
  GrindingJob job;
  job.blisk = treeOf(embeddedBlisk());
  job.blades = findBlades(job.blisk->mesh());
  ToolAssembly tool = builtInTool(0.1);
  job.parts = tool.parts;
  job.rules = tool.rules;
  job.rules.ground_blade = 1;
  job.rules.near_miss = 0.5;
  job.continuous = false;
  return job;
}

/// The depths of points in a solid, from FCL's distances.
class DepthsByFcl {
 public:
  explicit DepthsByFcl(const TriangleMesh& solid) : solid_(solid), model_(FclMesh(solid).model()) {
    constexpr double kTiny = 1e-7;
    point_ = FclMesh(TriangleMesh({{0, 0, 0}, {kTiny, 0, 0}, {0, kTiny, 0}}, {{0, 1, 2}})).model();
  }

  /// 0 for a point outside.
  double at(const Vec3& point) const {
    fcl::DistanceRequestd request;
    request.enable_nearest_points = true;
    fcl::DistanceResultd result;
    const double distance = fcl::distance<double>(model_.get(), fcl::Transform3d::Identity(), point_.get(),
                                                  fclTransform({Mat3::Identity(), point}), request, result);
    const Vec3 normal = scaledNormal(solid_.triangle(static_cast<std::size_t>(result.b1)));
    if (normal.dot(point - result.nearest_points[0]) >= 0.0) return 0.0;
    // If an edge is nearest, one of its triangles may report a point outside as inside.
    return testing::windingNumber(solid_, point) > 0.5 ? distance : 0.0;
  }

 private:
  const TriangleMesh& solid_;
  std::unique_ptr<FclModel> model_, point_;
};

TEST(GrindingRun, depths_vs_fcl) {
  GrindingJob job = builtInJob();
  const std::vector<Pose> whole = makeGrindingPath(job.blisk->mesh(), job.blades);
  for (std::size_t pose = 0; pose < whole.size(); pose += 3) job.path.push_back(whole[pose]);
  const GrindingRun run = runGrinding(job);
  const TriangleMesh& belt = job.parts.front().tree->mesh();
  const DepthsByFcl in_blisk(job.blisk->mesh()), in_belt(belt);
  constexpr double kLimit = 0.1, kTolerance = 0.02 * kLimit, kNear = 3.0;
  constexpr int kSteps = 3;
  int within = 0, beyond = 0, seen = 0;
  for (const PoseReport& pose : run.poses) {
    const bool by_depth_alone = pose.clearance->contact.distance > 0.0 && !pose.depths.empty();
    const bool too_deep = pose.verdict == Verdict::interference;
    int& asked = too_deep ? beyond : within;
    if (!by_depth_alone || asked == 8) continue;
    ++asked;
    // A grid of points on the triangles near the deepest point, the belt's in the blisk and the blisk's in
    // the belt: none is deeper, and one is about as deep.
    const Pose blisk_in_tool = pose.tool_in_blisk.inverse();
    double deepest = 0.0;
    const auto sample = [&](const TriangleMesh& mesh, const Pose& placed, const DepthsByFcl& depths,
                            const Pose& mesh_in_solid) {
      for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const Triangle corners = mesh.triangle(t);
        const Vec3 middle = centroidOf(corners);
        if ((placed * middle - pose.depths.front().point_on_blisk).norm() > kNear) continue;
        for (int i = 0; i <= kSteps; ++i) {
          for (int j = 0; i + j <= kSteps; ++j) {
            const Vec3 point =
                corners[0] + (corners[1] - corners[0]) * i / kSteps + (corners[2] - corners[0]) * j / kSteps;
            deepest = std::max(deepest, depths.at(mesh_in_solid * point));
            ++seen;
          }
        }
      }
    };
    sample(belt, pose.tool_in_blisk, in_blisk, pose.tool_in_blisk);
    sample(job.blisk->mesh(), Pose(), in_belt, blisk_in_tool);
    EXPECT_LE(deepest, pose.depths.front().depth + kTolerance);
    EXPECT_GE(deepest, 0.9 * pose.depths.front().depth - kTolerance);
    if (deepest > kLimit + kTolerance) {
      EXPECT_TRUE(too_deep);
    }
  }
  EXPECT_EQ(within, 8);
  EXPECT_GE(beyond, 4);
  EXPECT_GT(seen, 1000);
}

TEST(GrindingRun, verdicts_vs_fcl) {
  GrindingJob job = builtInJob();
  const std::vector<Pose> whole = makeGrindingPath(job.blisk->mesh(), job.blades);
  for (std::size_t pose = 0; pose < whole.size(); pose += 7) {
    job.path.push_back(whole[pose]);
    const double angle = (8.0 + 1.5 * static_cast<double>(pose % 5)) * std::numbers::pi / 180.0;
    const Pose towards_next_blade{Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero()};
    job.path.push_back(towards_next_blade * whole[pose]);
  }
  const GrindingRun run = runGrinding(job);

  const TriangleMesh& mesh = job.blisk->mesh();
  const auto is_ground = [&](std::size_t t) { return job.blades.blade_of_triangle[t] == 1; };
  const auto ground = FclMesh(mesh, is_ground).model();
  const auto others = FclMesh(mesh, [&](std::size_t t) { return !is_ground(t); }).model();
  const auto all = FclMesh(mesh).model();
  std::vector<std::unique_ptr<FclModel>> parts;
  for (const ToolPart& part : job.parts) parts.push_back(FclMesh(part.tree->mesh()).model());

  int forbidden = 0, intended = 0, clear = 0;
  for (const PoseReport& pose : run.poses) {
    const Pose& place = pose.tool_in_blisk;
    bool touches_forbidden = false;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t part = 0; part < parts.size(); ++part) {
      const FclModel& obstacle = part == 0 ? *others : *all;
      const bool touches = touch(obstacle, *parts[part], place);
      touches_forbidden |= touches;
      least = std::min(least, touches ? 0.0 : distanceOf(obstacle, *parts[part], place));
    }
    ASSERT_EQ(pose.clearance->contact.distance == 0.0, touches_forbidden);
    if (touches_forbidden) {
      EXPECT_EQ(pose.verdict, Verdict::interference);
      ++forbidden;
      continue;
    }
    EXPECT_NEAR(pose.clearance->contact.distance, least, 1e-6);
    if (touch(*ground, *parts[0], place)) {
      ++intended;
      const bool too_deep = !pose.depths.empty() && pose.depths.front().depth > 0.1;
      EXPECT_EQ(pose.verdict, too_deep       ? Verdict::interference
                              : least <= 0.5 ? Verdict::near_miss
                                             : Verdict::intended_contact);
    } else {
      ++clear;
      EXPECT_EQ(pose.verdict, least <= 0.5 ? Verdict::near_miss : Verdict::clear);
    }
  }
  const auto count = static_cast<int>(run.poses.size());
  EXPECT_GT(forbidden, count * 3 / 10);
  EXPECT_LT(forbidden, count * 7 / 10);
  EXPECT_GT(intended, count / 10);
  EXPECT_GT(clear, count / 20);
}

}  // namespace
}  // namespace octoblisk::demos
