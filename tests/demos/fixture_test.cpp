// Obstacles beside the blisk, compared with each part's own touches and distances, in grind and in the judge.
#include "grinding/fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demos/block.h"
#include "demos/grind_command.h"
#include "demos/read_table.h"
#include "demos/refusal.h"
#include "grinding/grinding_run.h"
#include "grinding/judge.h"
#include "io/mesh_file.h"
#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

/// The built-in grinder on every third pose of its path.
GrindingJob builtInJob() {
  GrindingJob job;
  job.blisk = treeOf(embeddedBlisk());
  job.blades = findBlades(job.blisk->mesh());
  for (EmbeddedPart& part : embeddedBeltGrinder()) {
    job.parts.push_back({part.name, treeOf(std::move(part.mesh))});
  }
  const std::vector<Pose> path = makeGrindingPath(job.blisk->mesh(), job.blades);
  for (std::size_t i = 0; i < path.size(); i += 3) job.path.push_back(path[i]);
  job.rules.near_miss = 0.5;
  return job;
}

TEST(Fixture, isJudgedLikeTheRest_vs_collideOfEachPart) {
  GrindingJob job = builtInJob();
  const GrindingRun without = runGrinding(job);
  // A clamp that the arm passes through at some poses, and a peg beside it that is near at some poses.
  job.fixtures = {{"clamp", treeOf(moved(block({30, 20, 60}, 2), Vec3(330, 40, 0)))},
                  {"peg", treeOf(moved(block({2, 2, 2}, 1), Vec3(300, 58, 0)))}};
  const GrindingRun run = runGrinding(job);
  const int first = job.blades.count + 1;
  Judge judge(job.blisk, job.parts, job.blades.blade_of_triangle, {.near_miss = 0.0}, 0, job.fixtures);
  Judge judge_without(job.blisk, job.parts, job.blades.blade_of_triangle, {.near_miss = 0.0});
  const auto states = judge.statesOf(job.path), states_without = judge_without.statesOf(job.path);
  std::size_t touched = 0, near = 0, neither = 0;
  for (std::size_t p = 0; p < run.poses.size(); ++p) {
    const PoseReport &pose = run.poses[p], &other = without.poses[p];
    double least = std::numeric_limits<double>::infinity();
    bool touches = false;
    for (std::size_t f = 0; f < job.fixtures.size(); ++f) {
      for (std::size_t part = 0; part < job.parts.size(); ++part) {
        const ClusteredOctree &fixture = *job.fixtures[f].tree, &tree = *job.parts[part].tree;
        const double apart = distance(fixture, tree, job.path[p]).distance;
        least = std::min(least, apart);
        const bool meet = collide(fixture, tree, job.path[p]).has_value();
        touches |= meet;
        bool is_reported = false;
        for (const Touch& touch : pose.touches) {
          is_reported |= touch.part == part && touch.blade == first + static_cast<int>(f);
        }
        EXPECT_EQ(is_reported, apart <= 0.5) << p << " part " << part << " fixture " << f;
      }
    }
    ASSERT_EQ(states[p].obstacle.has_value(), states_without[p].obstacle.has_value() || touches) << p;
    if (touches) {
      EXPECT_EQ(pose.verdict, Verdict::interference) << p;
      ++touched;
    } else if (least <= 0.5) {
      EXPECT_EQ(pose.verdict, std::max(other.verdict, Verdict::near_miss)) << p;
      ++near;
    } else {
      EXPECT_EQ(pose.verdict, other.verdict) << p;
      ++neither;
    }
    ASSERT_TRUE(pose.clearance);
    EXPECT_EQ(pose.clearance->contact.distance, std::min(least, other.clearance->contact.distance)) << p;
    ASSERT_EQ(pose.depths.size(), other.depths.size());
    for (std::size_t d = 0; d < pose.depths.size(); ++d) {
      EXPECT_EQ(pose.depths[d].depth, other.depths[d].depth) << "depths are measured only in the blisk";
    }
  }
  EXPECT_GE(touched, run.poses.size() / 5);
  EXPECT_GE(neither, run.poses.size() / 10);
  EXPECT_GE(near, 1u);
}

TEST(Fixture, nothingPassesThroughAThinOne) {
  const TriangleMesh far_off = moved(block({1, 1, 1}, 1), Vec3(100, 0, 0));
  const std::vector<Fixture> plate = {{"plate", treeOf(block({0.01, 20, 20}, 1))}};
  Judge judge(treeOf(far_off), {{"bit", treeOf(block({1, 1, 1}, 1))}},
              std::vector<int>(far_off.triangleCount(), 1), {.grinding_part = kNoPart, .near_miss = 0.0}, 1,
              plate);
  const std::vector<MotionEnds> motions = {{at(-5, 0, 0), at(5, 0, 0)}, {at(-5, 0, 0), at(-5, 9, 0)}};
  const auto found = judge.obstaclesOf(motions);
  ASSERT_TRUE(found[0]);
  EXPECT_EQ(found[0]->blade, 2);
  EXPECT_FALSE(found[1]);
}

TEST(Fixture, aToolWhollyInsideOneInterferes) {
  const TriangleMesh far_off = moved(block({1, 1, 1}, 1), Vec3(100, 0, 0));
  const auto bit = treeOf(block({1, 1, 1}, 2)), table = treeOf(block({20, 20, 20}, 1)),
             bead = treeOf(block({0.1, 0.1, 0.1}, 1));
  TriangleMesh open = block({20, 20, 20}, 1);
  open = TriangleMesh(open.vertices(), {open.triangles().begin(), open.triangles().end() - 2});
  const auto shell = treeOf(std::move(open));
  struct Case {
    std::shared_ptr<const ClusteredOctree> fixture;
    Pose tool;
    bool is_inside;
  };
  for (const auto& [fixture, tool, is_inside] :
       {Case{table, at(0, 0, 0), true}, Case{table, at(30, 0, 0), false}, Case{bead, at(0, 0, 0), true},
        Case{bead, at(0, 3, 0), false}, Case{shell, at(0, 0, 0), false}, Case{shell, at(30, 0, 0), false}}) {
    GrindingJob job;
    job.blisk = treeOf(far_off);
    job.blades.blade_of_triangle.assign(far_off.triangleCount(), 0);
    job.parts = {{"bit", bit}};
    job.fixtures = {{"table", fixture}};
    job.rules = {.grinding_part = kNoPart, .ground_blade = 0, .near_miss = 0.5};
    job.path = {tool};
    ASSERT_FALSE(collide(*fixture, *bit, tool));
    const GrindingRun run = runGrinding(job);
    EXPECT_EQ(run.poses.front().verdict, is_inside ? Verdict::interference : Verdict::clear);
    Judge judge(job.blisk, job.parts, job.blades.blade_of_triangle, job.rules, 1, job.fixtures);
    const auto state = judge.statesOf(job.path).front();
    ASSERT_EQ(state.obstacle.has_value(), is_inside);
    if (!is_inside) continue;
    EXPECT_TRUE(state.obstacle->is_inside);
    EXPECT_EQ(run.names().nameOf(worstTouch(run.poses.front())->blade), "table");
  }
}

/// A bit that may touch a block of half extents 5 at the origin as deep as 3, and a table.
GrindingJob bitBesideATable(TriangleMesh table) {
  const TriangleMesh blisk = block({5, 5, 5}, 1);
  GrindingJob job;
  job.blisk = treeOf(blisk);
  job.blades.blade_of_triangle.assign(blisk.triangleCount(), 0);
  job.parts = {{"bit", treeOf(block({1, 1, 1}, 1))}};
  job.fixtures = {{"table", treeOf(std::move(table))}};
  job.rules = {.grinding_part = kNoPart,
               .ground_blade = 0,
               .max_depth = 3.0,
               .allowed = {{std::nullopt, {BladeChoice::Kind::any, 0}}},
               .near_miss = 0.5};
  return job;
}

TEST(Fixture, aRowThatAllowsAnyBladeAllowsNoFixture) {
  GrindingJob job = bitBesideATable(moved(block({5, 5, 5}, 1), Vec3(0, 20, 0)));
  job.path = {at(0, 5.5, 0), at(0, 14.5, 0)};
  job.continuous = false;
  const GrindingRun run = runGrinding(job);
  EXPECT_EQ(run.poses[0].verdict, Verdict::intended_contact);
  EXPECT_EQ(run.poses[1].verdict, Verdict::interference);
}

TEST(Fixture, aMotionIntoOneIsJudgedForAPartThatMayTouchTheBlisk) {
  GrindingJob job = bitBesideATable(moved(block({9, 9, 9}, 1), Vec3(0, 40, 0)));
  job.path = {at(0, 40, 0), at(0, 41, 0), at(0, 20, 0), at(0, 5.5, 0)};
  const GrindingRun run = runGrinding(job);
  EXPECT_EQ(run.poses[0].verdict, Verdict::interference);
  EXPECT_EQ(run.poses[1].verdict, Verdict::interference);
  EXPECT_EQ(run.poses[2].verdict, Verdict::clear);
  EXPECT_EQ(run.poses[3].verdict, Verdict::intended_contact);
  EXPECT_EQ(run.poses[3].motion.value().outcome, MotionReport::Outcome::free);
}

TEST_F(GrindCommand, obstaclesAreNamedInTheTablesAndInWords) {
  writeMesh(file("clamp.obj"), moved(block({30, 20, 60}, 2), Vec3(330, 40, 0)));
  writeMesh(file("table,1.obj"), moved(block({400, 400, 200}, 1), Vec3(0, 0, -320)));
  const Outcome outcome = run("--obstacle 'clamp.obj,left clamp' --obstacle 'table,1.obj,table' --out run");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
  EXPECT_EQ(outcome.error, "");
  EXPECT_THAT(outcome.out, HasSubstr("Worst: pose "));
  EXPECT_THAT(outcome.out, HasSubstr(" on left clamp, "));
  std::size_t on_clamp = 0;
  for (const auto& row : readTable(file("run/poses.csv"))) on_clamp += row.at("blade") == "left clamp";
  EXPECT_GT(on_clamp, 100u);
  EXPECT_THAT(contentOf(file("run/contacts.csv")), HasSubstr(",left clamp,"));
  EXPECT_THAT(contentOf(file("run/summary.json")),
              HasSubstr("\"obstacles\": [\n    \"left clamp\",\n    \"table\"\n  ]"));
  EXPECT_THAT(contentOf(file("run/report.html")), HasSubstr("\"obstacles\":[\"left clamp\",\"table\"]"));
}

TEST_F(GrindCommand, refusesObstaclesThatAreNone) {
  writeMesh(file("clamp.obj"), block({1, 1, 1}, 1));
  expectRefusal(run("--obstacle none.stl --out run"), "none.stl: no such file");
  expectRefusal(run("--obstacle clamp.obj,3 --out run"),
                "--obstacle clamp.obj,3: '3': a name must consist of");
  expectRefusal(run("--obstacle clamp.obj --obstacle clamp.obj --out run"),
                "--obstacle clamp.obj: two obstacles have the name 'clamp'");
}

}  // namespace
}  // namespace octoblisk::demos
