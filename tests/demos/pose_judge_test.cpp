// Whether a pose is free: against octoblisk grind's own way of judging, and by every pair of triangles.
#include "grinding/pose_judge.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "demos/block.h"
#include "grinding/grinding_cell.h"
#include "grinding/reduce_contacts.h"
#include "grinding/verdict.h"
#include "models/blade_finder.h"
#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "shared/brute_force.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {
namespace {

Pose at(double x, double y, double z) { return {Mat3::Identity(), Vec3(x, y, z)}; }

std::vector<ToolPart> defaultGrinder() {
  std::vector<ToolPart> parts;
  for (EmbeddedPart& part : embeddedBeltGrinder()) parts.push_back({part.name, treeOf(std::move(part.mesh))});
  return parts;
}

/// As octoblisk grind judges.
std::vector<PoseReport> judgedByGrind(const std::shared_ptr<const ClusteredOctree>& blisk,
                                      const std::vector<ToolPart>& parts, const BladesFound& blades,
                                      const std::vector<Pose>& poses, const VerdictRules& rules) {
  GrindingCell cell(blisk, parts, 0.5);
  const auto depths = PartDepths(blisk, parts, rules.max_depth).measure(poses);
  std::vector<PoseReport> reports;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    PoseReport report;
    report.contacts = reduceContacts(cell.contactsAt(poses[i]), blades.blade_of_triangle);
    for (const PartContact& found : report.contacts) {
      report.blades.push_back(blades.blade_of_triangle[found.contact.triangle_a]);
    }
    report.depths = depths[i];
    for (const PartDepth& depth : report.depths) {
      report.depth_blades.push_back(blades.blade_of_triangle[depth.triangle_of_blisk]);
    }
    reports.push_back(std::move(report));
  }
  judge(reports, rules);
  return reports;
}

TEST(PoseJudge, callsFreeWhatGrindDoesNotCallInterference) {
  const auto blisk = treeOf(embeddedBlisk());
  const BladesFound blades = findBlades(blisk->mesh());
  const std::vector<ToolPart> parts = defaultGrinder();
  const std::vector<Pose> path = makeGrindingPath(blisk->mesh(), blades);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> tilt(-0.6, 0.6), shift(-0.15, 0.15);
  std::vector<Pose> poses;
  for (std::size_t i = 2; i < path.size(); i += 9) {
    poses.push_back(path[i]);
    Pose changed = path[i];
    changed.rotation = Mat3(path[i].rotation * Eigen::AngleAxisd(tilt(random), Vec3::UnitZ()));
    changed.translation += Vec3{shift(random), shift(random), shift(random)};
    poses.push_back(changed);
  }
  const VerdictRules rules{0, 1, 0.1};
  const auto reports = judgedByGrind(blisk, parts, blades, poses, rules);
  PoseJudge judge(blisk, parts, blades.blade_of_triangle, {0, 1, rules.max_depth, 0.0});
  const std::vector<PoseState> states = judge.judge(poses);
  std::size_t free = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(!states[i].obstacle, reports[i].verdict != Verdict::interference) << "pose " << i;
    if (states[i].obstacle) {
      const auto named = [&](const PartContact& contact) { return contact.part == states[i].obstacle->part; };
      EXPECT_TRUE(std::ranges::any_of(reports[i].contacts, named)) << "pose " << i;
      continue;
    }
    ++free;
    EXPECT_EQ(states[i].grinds, reports[i].verdict == Verdict::intended_contact ||
                                    (reports[i].verdict == Verdict::near_miss && !reports[i].depths.empty()))
        << "pose " << i;
  }
  EXPECT_GT(free, 3 * poses.size() / 10);
  EXPECT_LT(free, 7 * poses.size() / 10);

  // The same bits from one thread.
  PoseJudge alone(blisk, parts, blades.blade_of_triangle, {0, 1, rules.max_depth, 0.0}, 1);
  const std::vector<PoseState> same = alone.judge(poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ASSERT_EQ(same[i].obstacle.has_value(), states[i].obstacle.has_value());
    if (!same[i].obstacle) continue;
    EXPECT_EQ(same[i].obstacle->part, states[i].obstacle->part);
    EXPECT_EQ(same[i].obstacle->blade, states[i].obstacle->blade);
  }
}

/// Two plates, above and below y = 0, with a gap between.
TriangleMesh slot(double half_gap) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  const TriangleMesh plate = block({60, 5, 20}, 3);
  for (const double side : {-1.0, 1.0}) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& v : plate.vertices()) vertices.push_back(v + Vec3(0.0, side * (half_gap + 5.0), 0.0));
    for (const auto& [a, b, c] : plate.triangles()) triangles.push_back({first + a, first + b, first + c});
  }
  return {vertices, triangles};
}

TEST(PoseJudge, equalsEveryPairOfTrianglesOfASlotAndABar) {
  const TriangleMesh walls = slot(6.6), bar = block({15, 2, 3}, 2);
  PoseJudge judge(treeOf(walls), {{"bar", treeOf(bar)}}, std::vector<int>(walls.triangleCount(), 0),
                  {.ground_blade = 0}, 2);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-0.5, 0.5), shift(-3.0, 3.0);
  std::vector<Pose> poses;
  for (int k = 0; k < 200; ++k) {
    poses.push_back({Mat3(Eigen::AngleAxisd(angle(random), Vec3::UnitZ())),
                     Vec3{shift(random), shift(random), shift(random)}});
  }
  const auto states = judge.judge(poses);
  std::size_t free = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const bool touches = !testing::bruteForcePairs(walls, bar, poses[k]).empty();
    EXPECT_EQ(states[k].obstacle.has_value(), touches) << k;
    free += !touches;
  }
  EXPECT_GT(free, poses.size() * 3 / 10);
  EXPECT_LT(free, poses.size() * 7 / 10);
}

TEST(PoseJudge, knowsWhatIsWhollyInsideAndWhatIsTooNear) {
  const TriangleMesh wall = block({20, 20, 20}, 4);
  const std::vector<int> blades(wall.triangleCount(), 0);
  const std::vector<Pose> poses = {at(0, 0, 0), at(40, 0, 0), at(23.2, 0, 0), at(23.0, 0, 0)};
  PoseJudge touch(treeOf(wall), {{"bit", treeOf(block({3, 3, 3}, 2))}}, blades, {.ground_blade = 0});
  auto states = touch.judge(poses);
  ASSERT_TRUE(states[0].obstacle);
  EXPECT_TRUE(states[0].obstacle->is_inside);
  EXPECT_FALSE(states[1].obstacle);
  EXPECT_FALSE(states[2].obstacle);
  ASSERT_TRUE(states[3].obstacle) << "it just touches";
  EXPECT_FALSE(states[3].obstacle->is_inside);

  PoseJudge apart(treeOf(wall), {{"bit", treeOf(block({3, 3, 3}, 2))}}, blades,
                  {.ground_blade = 0, .margin = 0.3});
  states = apart.judge(poses);
  EXPECT_FALSE(states[1].obstacle);
  EXPECT_TRUE(states[2].obstacle) << "0.2 mm apart";

  PoseJudge round(treeOf(wall), {{"cage", treeOf(block({30, 30, 30}, 2))}}, blades, {.ground_blade = 0});
  EXPECT_TRUE(round.judge({&poses[0], 1}).front().obstacle->is_inside);
}

TEST(PoseJudge, judgesThePressOnTheGroundBladeAloneByItsDepth) {
  // The block's face x = 20 is the ground blade, its other faces the rest.
  const TriangleMesh wall = block({20, 20, 20}, 4);
  std::vector<int> blades(wall.triangleCount(), 0);
  for (std::size_t t = 0; t < blades.size(); ++t) {
    const Triangle corners = wall.triangle(t);
    blades[t] = corners[0].x() == 20 && corners[1].x() == 20 && corners[2].x() == 20;
  }
  PoseJudge judge(treeOf(wall), {{"belt", treeOf(block({3, 3, 3}, 3))}}, blades, {.max_depth = 0.1});
  const std::vector<Pose> poses = {at(23.01, 0, 0), at(22.92, 1, 0.3), at(22.88, 1, 0.3), at(21.0, 1, 0.3),
                                   at(22.95, 18.5, 0)};
  const auto states = judge.judge(poses);
  EXPECT_FALSE(states[0].obstacle);
  EXPECT_FALSE(states[0].grinds);
  EXPECT_FALSE(states[1].obstacle) << "0.08 mm deep";
  EXPECT_TRUE(states[1].grinds);
  for (const std::size_t deep : {2u, 3u}) {
    ASSERT_TRUE(states[deep].obstacle) << "beyond 0.1 mm";
    EXPECT_TRUE(states[deep].obstacle->too_deep);
    EXPECT_EQ(states[deep].obstacle->blade, 1);
  }
  ASSERT_TRUE(states[4].obstacle) << "over the edge: another face is touched too";
  EXPECT_EQ(states[4].obstacle->blade, 0);
}

}  // namespace
}  // namespace octoblisk::demos
