// Whether a pose or a motion is free, compared with octoblisk grind's own judgement and with every triangle
// pair.
#include "grinding/judge.h"

#include <gtest/gtest.h>

#include <random>

#include "demos/block.h"
#include "grinding/grinding_cell.h"
#include "grinding/grinding_run.h"
#include "grinding/verdict.h"
#include "models/blade_finder.h"
#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "shared/brute_force.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {
namespace {

std::vector<ToolPart> defaultGrinder() {
  std::vector<ToolPart> parts;
  for (EmbeddedPart& part : embeddedBeltGrinder()) parts.push_back({part.name, treeOf(std::move(part.mesh))});
  return parts;
}

/// Judges as octoblisk grind does.
std::vector<PoseReport> judgedByGrind(const std::shared_ptr<const ClusteredOctree>& blisk,
                                      const std::vector<ToolPart>& parts, const BladesFound& blades,
                                      const std::vector<Pose>& poses, const VerdictRules& rules) {
  GrindingCell cell(blisk, parts, std::vector<double>(parts.size(), 0.5));
  const auto depths = PartDepths(blisk, parts, rules.max_depth).measure(poses);
  std::vector<PoseReport> reports;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    PoseReport report;
    report.touches = reduceContacts(cell.touchesAt(poses[i]), blades.blade_of_triangle);
    report.depths = depths[i];
    for (PartDepth& depth : report.depths) depth.blade = blades.blade_of_triangle[depth.triangle_of_blisk];
    setVerdicts(report, rules);
    reports.push_back(std::move(report));
  }
  return reports;
}

TEST(Judge, callsFreeWhatGrindDoesNotCallInterference) {
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
  const VerdictRules rules{.near_miss = 0.0};
  const auto reports = judgedByGrind(blisk, parts, blades, poses, rules);
  Judge judge(blisk, parts, blades.blade_of_triangle, rules);
  const std::vector<PoseState> states = judge.statesOf(poses);
  std::size_t free = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(!states[i].obstacle, reports[i].verdict != Verdict::interference) << "pose " << i;
    if (states[i].obstacle) {
      const auto named = [&](const Touch& touch) { return touch.part == states[i].obstacle->part; };
      EXPECT_TRUE(std::ranges::any_of(reports[i].touches, named)) << "pose " << i;
      continue;
    }
    ++free;
    EXPECT_EQ(states[i].grinds, reports[i].verdict == Verdict::intended_contact ||
                                    (reports[i].verdict == Verdict::near_miss && !reports[i].depths.empty()))
        << "pose " << i;
  }
  EXPECT_GT(free, 3 * poses.size() / 10);
  EXPECT_LT(free, 7 * poses.size() / 10);

  // One thread must give the same bits.
  Judge alone(blisk, parts, blades.blade_of_triangle, rules, 1);
  const std::vector<PoseState> same = alone.statesOf(poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ASSERT_EQ(same[i].obstacle.has_value(), states[i].obstacle.has_value());
    if (!same[i].obstacle) continue;
    EXPECT_EQ(same[i].obstacle->part, states[i].obstacle->part);
    EXPECT_EQ(same[i].obstacle->blade, states[i].obstacle->blade);
  }
}

TEST(Judge, callsFreeWhatGrindCallsKnownAndAllowedBesideHoles) {
  const TriangleMesh closed = embeddedBlisk();
  const BladesFound whole = findBlades(closed);
  std::mt19937 random(5);
  std::vector<TriangleMesh::Indices> kept;
  for (std::size_t t = 0; t < closed.triangleCount(); ++t) {
    if (whole.blade_of_triangle[t] != 1 || random() % 6 != 0) kept.push_back(closed.triangles()[t]);
  }
  const auto blisk = treeOf(TriangleMesh(closed.vertices(), std::move(kept)));
  const BladesFound blades = findBlades(blisk->mesh());
  const std::vector<ToolPart> parts = defaultGrinder();
  const VerdictRules rules{.near_miss = 0.0};
  std::vector<Pose> poses;
  for (const double depth : {0.02, 0.08, 0.12}) {
    const auto path = makeGrindingPath(closed, whole, {.depth = depth});
    for (std::size_t i = 20; i + 20 < path.size(); i += 2) poses.push_back(path[i]);
  }
  const auto reports = judgedByGrind(blisk, parts, blades, poses, rules);
  const auto states = Judge(blisk, parts, blades.blade_of_triangle, rules).statesOf(poses);
  std::size_t free = 0, unknown = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(!states[i].obstacle, reports[i].verdict < Verdict::unknown) << "pose " << i;
    free += !states[i].obstacle;
    unknown += reports[i].verdict == Verdict::unknown;
  }
  EXPECT_GT(free, 20u);
  EXPECT_GT(unknown, 20u);
}

/// Without the triangles of the bore.
TriangleMesh boreCutOpen(const TriangleMesh& blisk) {
  const auto radius = [](const Vec3& point) { return std::hypot(point.x(), point.y()); };
  double bore = 1e9;
  for (const Vec3& vertex : blisk.vertices()) bore = std::min(bore, radius(vertex));
  std::vector<TriangleMesh::Indices> kept;
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    const bool is_of_bore = std::ranges::all_of(
        blisk.triangle(t), [&](const Vec3& corner) { return radius(corner) < bore + 0.5; });
    if (!is_of_bore) kept.push_back(blisk.triangles()[t]);
  }
  return {blisk.vertices(), std::move(kept)};
}

/// Every triangle of the blades twice.
TriangleMesh bladesDoubled(const TriangleMesh& blisk, const BladesFound& blades) {
  std::vector<TriangleMesh::Indices> triangles = blisk.triangles();
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    if (blades.blade_of_triangle[t] != 0) triangles.push_back(blisk.triangles()[t]);
  }
  return {blisk.vertices(), std::move(triangles)};
}

GrindingJob jobOn(TriangleMesh blisk, std::vector<Pose> path) {
  GrindingJob job;
  job.blisk = treeOf(std::move(blisk));
  job.blades = findBlades(job.blisk->mesh());
  job.parts = defaultGrinder();
  job.rules.near_miss = 0.5;
  job.path = std::move(path);
  job.continuous = false;
  return job;
}

TEST(Judge, aPressIsTooDeepFromTheLimitOnWithTheBoreCutOpenToo) {
  const TriangleMesh closed = embeddedBlisk(), open = boreCutOpen(closed);
  ASSERT_LT(open.triangleCount(), closed.triangleCount());
  const BladesFound blades = findBlades(closed);
  GrindingPathOptions options{.passes = 2, .poses_per_pass = 6, .span_to = 0.7, .retract_poses = 1};
  GrindingJob of_closed = jobOn(closed, {{}}), of_open = jobOn(open, {{}});
  const double limit = of_closed.rules.max_depth;
  std::size_t intended = 0, too_deep = 0;
  for (int hundredths = 0; hundredths <= 20; ++hundredths) {
    options.depth = 0.01 * hundredths;
    of_closed.path = of_open.path = makeGrindingPath(closed, blades, options);
    const GrindingRun whole = runGrinding(of_closed), cut = runGrinding(of_open);
    for (std::size_t p = 1; p + 1 < whole.poses.size(); ++p) {
      const PoseReport &a = whole.poses[p], &b = cut.poses[p];
      EXPECT_EQ(a.verdict, b.verdict) << "pose " << p << ", " << options.depth << " mm";
      if (a.depths.empty()) continue;
      ASSERT_EQ(b.depths.size(), a.depths.size());
      EXPECT_NEAR(b.depths[0].depth, a.depths[0].depth, 0.01 * limit);
      EXPECT_TRUE(b.depths[0].is_known);
      intended += b.verdict == Verdict::intended_contact;
      too_deep += b.verdict == Verdict::interference;
      if (b.verdict != Verdict::intended_contact && b.verdict != Verdict::interference) continue;
      // The belt is as deep as it is pressed, or deeper where the blade is hollow: to within 1 % and a chord
      // of its polygons.
      EXPECT_EQ(b.verdict == Verdict::interference, b.depths[0].depth > limit) << p << ' ' << options.depth;
      if (options.depth > 1.05 * limit) {
        EXPECT_EQ(b.verdict, Verdict::interference);
      }
    }
  }
  EXPECT_GT(intended, 50u);
  EXPECT_GT(too_deep, 50u);
}

TEST(Judge, aTouchOfADoubledSurfaceIsJudgedAsOfASingleOne) {
  const TriangleMesh closed = embeddedBlisk();
  const BladesFound blades = findBlades(closed);
  const std::vector<Pose> path = makeGrindingPath(
      closed, blades, {.passes = 2, .poses_per_pass = 8, .span_to = 0.7, .retract_poses = 1});
  const GrindingRun whole = runGrinding(jobOn(closed, path));
  const GrindingRun doubled = runGrinding(jobOn(bladesDoubled(closed, blades), path));
  Judge judge(doubled.job.blisk, defaultGrinder(), doubled.job.blades.blade_of_triangle, {.near_miss = 0.0});
  const std::vector<PoseState> states = judge.statesOf(path);
  std::size_t touching = 0;
  for (std::size_t p = 0; p < path.size(); ++p) {
    if (whole.poses[p].verdict != Verdict::intended_contact) continue;
    ++touching;
    EXPECT_EQ(doubled.poses[p].verdict, Verdict::intended_contact) << p;
    EXPECT_FALSE(states[p].obstacle) << p;
    ASSERT_EQ(doubled.poses[p].depths.size(), whole.poses[p].depths.size());
    EXPECT_NEAR(doubled.poses[p].depths[0].depth, whole.poses[p].depths[0].depth, 1e-3) << p;
    EXPECT_TRUE(doubled.poses[p].depths[0].is_known) << p;
  }
  EXPECT_GT(touching, 4u);
}

/// Two plates, above and below y = 0, with a gap between them.
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

TEST(Judge, judgesMovesForRepairAsForGrind) {
  const auto blisk = treeOf(embeddedBlisk());
  const BladesFound blades = findBlades(blisk->mesh());
  const std::vector<Pose> path = makeGrindingPath(blisk->mesh(), blades);
  GrindingJob job;
  job.blisk = blisk;
  job.blades = blades;
  job.parts = defaultGrinder();
  for (std::size_t i = 0; i < path.size(); i += 3) job.path.push_back(path[i]);
  job.rules.near_miss = 0.5;
  const GrindingRun run = runGrinding(job);
  job.rules.near_miss = 0.0;
  Judge judge(blisk, job.parts, blades.blade_of_triangle, job.rules);
  const std::vector<PoseState> states = judge.statesOf(job.path);
  std::vector<MotionEnds> motions;
  std::vector<std::size_t> led_to;
  for (std::size_t i = 0; i < job.path.size(); ++i) {
    EXPECT_EQ(!states[i].obstacle, run.poses[i].verdict != Verdict::interference) << "pose " << i;
    if (i == 0 || states[i - 1].obstacle || states[i].obstacle) continue;
    motions.push_back({job.path[i - 1], job.path[i]});
    led_to.push_back(i);
  }
  const auto obstacles = judge.obstaclesOf(motions);
  std::size_t blocked = 0;
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const MotionReport& motion = *run.poses[led_to[m]].motion;
    ASSERT_EQ(obstacles[m].has_value(), motion.hasFinding()) << "to " << led_to[m];
    if (!obstacles[m]) continue;
    ++blocked;
    EXPECT_EQ(obstacles[m]->part, motion.at.part);
    EXPECT_EQ(obstacles[m]->blade, motion.at.blade);
    EXPECT_EQ(obstacles[m]->too_deep, motion.outcome == MotionReport::Outcome::too_deep);
  }
  EXPECT_GT(blocked, 2u);
  EXPECT_GT(motions.size(), 3 * blocked);
}

TEST(Judge, findsARidgeBetweenPosesHalfAMillimetreApart) {
  // A ridge 0.3 wide and 0.4 high, and a pin that is pressed 0.02 into the face beside it.
  TriangleMesh plain = block({3, 3, 1}, 40);
  std::vector<Vec3> vertices = plain.vertices();
  for (Vec3& v : vertices) v.z() += v.z() == 1.0 && std::abs(v.x() - 0.3) < 1e-9 ? 0.4 : 0.0;
  const TriangleMesh ridge(vertices, plain.triangles());
  const std::vector<int> blades(ridge.triangleCount(), 1);
  const std::vector<ToolPart> pin = {{"pin", treeOf(block({0.02, 0.02, 0.5}, 1))}};
  Judge judge(treeOf(ridge), pin, blades, {.max_depth = 0.05, .near_miss = 0.0});
  const MotionEnds over{at(-1, 0.01, 1.48), at(1, 0.01, 1.48)}, beside{at(-2, 0.01, 1.48), at(0, 0.01, 1.48)};
  std::vector<Pose> between;
  for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) between.push_back(at(x, 0.01, 1.48));
  for (const PoseState& state : judge.statesOf(between)) {
    EXPECT_FALSE(state.obstacle);
    EXPECT_TRUE(state.grinds);
  }
  const std::vector<MotionEnds> motions = {over, beside};
  const auto found = judge.obstaclesOf(motions);
  ASSERT_TRUE(found[0]);
  EXPECT_TRUE(found[0]->too_deep);
  EXPECT_FALSE(found[1]);

  // For an open blisk nothing is proved, but the depth is measured every half millimetre.
  std::vector<TriangleMesh::Indices> open = ridge.triangles();
  std::erase_if(open, [&](const TriangleMesh::Indices& t) { return vertices[t[0]].x() == -3.0; });
  Judge of_open(treeOf(TriangleMesh(vertices, open)), {{"bar", treeOf(block({0.2, 0.5, 0.5}, 1))}},
                std::vector<int>(open.size(), 1), judge.rules());
  const std::vector<MotionEnds> of_bar = {over, {at(-2, 0.01, 1.48), at(-0.5, 0.01, 1.48)}};
  const auto found_of_open = of_open.obstaclesOf(of_bar);
  ASSERT_TRUE(found_of_open[0]);
  EXPECT_TRUE(found_of_open[0]->too_deep);
  EXPECT_FALSE(found_of_open[1]);
}

TEST(Judge, equalsEveryPairOfTrianglesOfASlotAndABar) {
  const TriangleMesh walls = slot(6.6), bar = block({15, 2, 3}, 2);
  Judge judge(treeOf(walls), {{"bar", treeOf(bar)}}, std::vector<int>(walls.triangleCount(), 0),
              {.ground_blade = 0, .near_miss = 0.0}, 2);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-0.5, 0.5), shift(-3.0, 3.0);
  std::vector<Pose> poses;
  for (int k = 0; k < 200; ++k) {
    poses.push_back({Mat3(Eigen::AngleAxisd(angle(random), Vec3::UnitZ())),
                     Vec3{shift(random), shift(random), shift(random)}});
  }
  const auto states = judge.statesOf(poses);
  std::size_t free = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const bool touches = !testing::bruteForcePairs(walls, bar, poses[k]).empty();
    EXPECT_EQ(states[k].obstacle.has_value(), touches) << k;
    free += !touches;
  }
  EXPECT_GT(free, poses.size() * 3 / 10);
  EXPECT_LT(free, poses.size() * 7 / 10);
}

TEST(Judge, knowsWhatIsWhollyInsideAndWhatIsTooNear) {
  const TriangleMesh wall = block({20, 20, 20}, 4);
  const std::vector<int> blades(wall.triangleCount(), 0);
  const std::vector<Pose> poses = {at(0, 0, 0), at(40, 0, 0), at(23.2, 0, 0), at(23.0, 0, 0)};
  Judge touch(treeOf(wall), {{"bit", treeOf(block({3, 3, 3}, 2))}}, blades,
              {.ground_blade = 0, .near_miss = 0.0});
  auto states = touch.statesOf(poses);
  ASSERT_TRUE(states[0].obstacle);
  EXPECT_TRUE(states[0].obstacle->is_inside);
  EXPECT_FALSE(states[1].obstacle);
  EXPECT_FALSE(states[2].obstacle);
  ASSERT_TRUE(states[3].obstacle) << "it just touches";
  EXPECT_FALSE(states[3].obstacle->is_inside);

  Judge apart(treeOf(wall), {{"bit", treeOf(block({3, 3, 3}, 2))}}, blades,
              {.ground_blade = 0, .near_miss = 0.3});
  states = apart.statesOf(poses);
  EXPECT_FALSE(states[1].obstacle);
  EXPECT_TRUE(states[2].obstacle) << "0.2 mm apart";

  Judge round(treeOf(wall), {{"cage", treeOf(block({30, 30, 30}, 2))}}, blades,
              {.ground_blade = 0, .near_miss = 0.0});
  EXPECT_TRUE(round.statesOf({&poses[0], 1}).front().obstacle->is_inside);
}

TEST(Judge, judgesThePressOnTheGroundBladeAloneByItsDepth) {
  // The block's face x = 20 is the ground blade; its other faces are the rest.
  const TriangleMesh wall = block({20, 20, 20}, 4);
  std::vector<int> blades(wall.triangleCount(), 0);
  for (std::size_t t = 0; t < blades.size(); ++t) {
    const Triangle corners = wall.triangle(t);
    blades[t] = corners[0].x() == 20 && corners[1].x() == 20 && corners[2].x() == 20;
  }
  Judge judge(treeOf(wall), {{"belt", treeOf(block({3, 3, 3}, 3))}}, blades,
              {.max_depth = 0.1, .near_miss = 0.0});
  const std::vector<Pose> poses = {at(23.01, 0, 0), at(22.92, 1, 0.3), at(22.88, 1, 0.3), at(21.0, 1, 0.3),
                                   at(22.95, 18.5, 0)};
  const auto states = judge.statesOf(poses);
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
