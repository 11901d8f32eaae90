#include "toolpath/surface_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "demos/command.h"
#include "demos/default_blisk.h"
#include "demos/read_table.h"
#include "demos/refusal.h"
#include "demos/scratch_folder.h"
#include "io/mesh_file.h"
#include "models/blade_anatomy.h"
#include "models/blisk.h"
#include "models/radians.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/clustered_octree.h"
#include "toolpath/cl_motions.h"
#include "toolpath/path_file.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

constexpr int kBlade = 4;
using enum BladeRegion;
using enum PathPattern;

const BladeContours& contours() {
  static const BladeContours result(blisk().mesh, findBladeSides(blisk().mesh, findBlades(blisk().mesh)),
                                    kBlade);
  return result;
}

/// The generator's triangles of the blade.
const ClusteredOctree& bladeTree() {
  static const ClusteredOctree result = [] {
    std::vector<TriangleMesh::Indices> triangles;
    for (std::size_t t = 0; t < blisk().mesh.triangleCount(); ++t) {
      if (blisk().blade_of_triangle[t] == kBlade) triangles.push_back(blisk().mesh.triangles()[t]);
    }
    return ClusteredOctree::build(
        std::make_shared<const TriangleMesh>(blisk().mesh.vertices(), std::move(triangles)));
  }();
  return result;
}

Vec3 tangential(const Vec3& p) { return Vec3(-p.y(), p.x(), 0.0).normalized(); }

/// n of the docstring, from a pose.
Vec3 normalOf(const Pose& pose, double tilt) {
  return std::sin(radians(tilt)) * pose.rotation.col(0) + std::cos(radians(tilt)) * pose.rotation.col(1);
}

Vec3 contactOf(const Pose& pose, const SurfacePathOptions& options) {
  return pose.translation - (options.wheel_radius - options.depth) * normalOf(pose, options.tilt);
}

std::map<int, std::vector<Vec3>> contactsByPass(const SurfacePath& path, const SurfacePathOptions& options) {
  std::map<int, std::vector<Vec3>> passes;
  for (std::size_t k = 0; k < path.motions.size(); ++k) {
    if (path.pass_of_motion[k] < 0) continue;
    passes[path.pass_of_motion[k]].push_back(contactOf(path.motions[k].tool_in_blisk, options));
  }
  return passes;
}

double distanceToLine(const std::vector<Vec3>& line, const Vec3& point) {
  double least = (line.front() - point).norm();
  for (std::size_t k = 1; k < line.size(); ++k) {
    least = std::min(least, distance(Triangle{line[k - 1], line[k], line[k]}, point));
  }
  return least;
}

struct PathCase {
  BladeRegion region;
  PathPattern pattern;
  double step_over, tilt, lead;
};

class SurfacePaths : public ::testing::TestWithParam<PathCase> {
 protected:
  SurfacePathOptions options() const {
    SurfacePathOptions result;
    result.region = GetParam().region;
    result.pattern = GetParam().pattern;
    result.step_over = GetParam().step_over;
    result.tilt = GetParam().tilt;
    result.lead = GetParam().lead;
    result.feed = 750.0;
    return result;
  }
};

TEST_P(SurfacePaths, eachPoseTouchesTheRegionOfItsBladeWithTheTiltAndLeadAskedFor) {
  const SurfacePath path = makeSurfacePath(contours(), options());
  ASSERT_EQ(path.motions.size(), path.pass_of_motion.size());
  const bool at_edge = isEdge(options().region);
  for (std::size_t k = 0; k < path.motions.size(); ++k) {
    const Pose& pose = path.motions[k].tool_in_blisk;
    ASSERT_TRUE((pose.rotation.transpose() * pose.rotation).isIdentity(1e-12));
    ASSERT_NEAR(pose.rotation.determinant(), 1.0, 1e-12);
    if (path.motions[k].feed == 0.0) {
      EXPECT_EQ(path.pass_of_motion[k], -1);
      continue;
    }
    EXPECT_EQ(path.motions[k].feed, 750.0);
    const Vec3 contact = contactOf(pose, options());
    const auto closest = closestPoint(bladeTree(), contact).value();
    ASSERT_LT(closest.distance, 1e-6) << "on the blade";
    const Vec3 normal = normalOf(pose, options().tilt);
    const Vec3 facet = unitNormal(bladeTree().mesh().triangle(closest.triangle));
    EXPECT_GT(normal.dot(facet), at_edge ? 0.3 : 0.99) << "few facets go around the edge";
    const double facing = normal.dot(tangential(contact));
    const double side = options().region == forward ? 1.0 : -1.0;
    EXPECT_TRUE(at_edge || side * facing > 0.3) << facing;

    // Tilt: the arm's angle above the tangent plane. Lead: its projection's angle from the outward direction.
    const Vec3 arm = pose.rotation.col(0);
    EXPECT_NEAR(std::asin(arm.dot(normal)), radians(options().tilt), 1e-9);
    EXPECT_NEAR(pose.rotation.col(2).dot(normal), 0.0, 1e-12) << "the wheel lies on the surface";
    const Vec3 outward = Vec3(contact.x(), contact.y(), 0.0).normalized();
    const Vec3 up = (outward - outward.dot(normal) * normal).normalized();
    const Vec3 in_surface = (arm - arm.dot(normal) * normal).normalized();
    EXPECT_NEAR(std::acos(std::clamp(up.dot(in_surface), -1.0, 1.0)), std::abs(radians(options().lead)),
                1e-6);
    if (!at_edge && options().lead != 0.0) {
      EXPECT_GT(options().lead * (in_surface - up.dot(in_surface) * up).z(), 0.0)
          << "towards the trailing edge";
    }
  }
}

TEST_P(SurfacePaths, passesKeepTheStepOverAndAreNoMoreThanNeeded) {
  SurfacePathOptions fine = options();
  fine.pose_step = 0.5;
  const auto passes = contactsByPass(makeSurfacePath(contours(), fine), fine);
  ASSERT_GE(passes.size(), 3u);
  double greatest = 0.0;
  for (auto pass = passes.begin(); std::next(pass) != passes.end(); ++pass) {
    const std::vector<Vec3>& next = std::next(pass)->second;
    double widest = 0.0;
    for (const Vec3& contact : pass->second) widest = std::max(widest, distanceToLine(next, contact));
    EXPECT_LE(widest, fine.step_over + 1e-9);
    greatest = std::max(greatest, widest);
  }
  // In space the distance may be shorter than along the surface, especially around the edge.
  EXPECT_GT(greatest, (isEdge(fine.region) && fine.pattern == longitudinal ? 0.4 : 0.7) * fine.step_over);
}

TEST_P(SurfacePaths, stepsAreSmallAndPassesGoInTheGivenDirection) {
  const SurfacePath path = makeSurfacePath(contours(), options());
  const auto passes = contactsByPass(path, options());
  for (const auto& [pass, contacts] : passes) {
    for (std::size_t k = 1; k < contacts.size(); ++k) {
      EXPECT_LE((contacts[k] - contacts[k - 1]).norm(), options().pose_step + 1e-9);
    }
    const auto radius = [](const Vec3& p) { return std::hypot(p.x(), p.y()); };
    const double rise = std::abs(radius(contacts.front()) - radius(contacts.back()));
    if (options().pattern == longitudinal) {
      EXPECT_GT(rise, 50.0);
    } else {
      EXPECT_LT(rise, 8.0);
    }
    if (isEdge(options().region)) {
      double from_edge = 1e9;
      for (int step = 0; step <= 100; ++step) {
        const std::vector<ContourPoint> side = contours().at(0.4 + 0.006 * step).forward;
        const ContourPoint& edge = options().region == leading_edge ? side.front() : side.back();
        from_edge = std::min(from_edge, (edge.position - contacts[contacts.size() / 2]).norm());
      }
      EXPECT_LE(from_edge, options().edge_reach + 0.5);
    }
  }
  for (std::size_t k = 1; k < path.motions.size(); ++k) {
    const Pose& from = path.motions[k - 1].tool_in_blisk;
    const Pose& to = path.motions[k].tool_in_blisk;
    EXPECT_LE((to.translation - from.translation).norm(), 2.0 * options().pose_step) << k;
    EXPECT_LE(Eigen::AngleAxisd(Mat3(from.rotation.transpose() * to.rotation)).angle(), radians(12.0)) << k;
  }
  EXPECT_EQ(path.motions.front().feed, 0.0);
  EXPECT_EQ(path.motions.back().feed, 0.0);
  EXPECT_GT(closestPoint(bladeTree(), path.motions.front().tool_in_blisk.translation).value().distance, 9.5);
}

INSTANTIATE_TEST_SUITE_P(Patterns, SurfacePaths,
                         ::testing::Values(PathCase{forward, transversal, 5.0, 8.0, 0.0},
                                           PathCase{backward, transversal, 3.0, -4.0, 12.0},
                                           PathCase{forward, longitudinal, 10.0, 8.0, -15.0},
                                           PathCase{backward, longitudinal, 7.0, 0.0, 5.0},
                                           PathCase{leading_edge, transversal, 4.0, 5.0, 0.0},
                                           PathCase{leading_edge, longitudinal, 1.0, 8.0, 10.0},
                                           PathCase{trailing_edge, transversal, 4.0, 5.0, 0.0},
                                           PathCase{trailing_edge, longitudinal, 1.0, 8.0, 10.0}));

TEST(SurfacePathChoices, areCheckedInOneLine) {
  const auto refusal = [](auto change) {
    SurfacePathOptions options;
    change(options);
    return messageOf<std::invalid_argument>([&] { makeSurfacePath(contours(), options); });
  };
  EXPECT_THAT(refusal([](auto& o) { o.step_over = 0.0; }), HasSubstr("step-over"));
  EXPECT_THAT(refusal([](auto& o) { o.pose_step = std::nan(""); }), HasSubstr("pose"));
  EXPECT_THAT(refusal([](auto& o) { o.tilt = 90.0; }), HasSubstr("tilt"));
  EXPECT_THAT(refusal([](auto& o) { o.lead = std::nan(""); }), HasSubstr("lead"));
  EXPECT_THAT(refusal([](auto& o) { o.feed = -1.0; }), HasSubstr("feed"));
  EXPECT_THAT(refusal([](auto& o) { o.height_from = 1.1; }), HasSubstr("height"));
  EXPECT_THAT(refusal([](auto& o) { o.height_from = 0.98; }), HasSubstr("height"));
  EXPECT_THAT(refusal([](auto& o) { o.edge_margin = 60.0; }), HasSubstr("--edge-margin"));
  EXPECT_THAT(refusal([](auto& o) { o.step_over = 1e-9; }), HasSubstr("1,000,000"));
  EXPECT_THAT(refusal([](auto& o) { o.pose_step = 1e-9; }), HasSubstr("1,000,000"));
}

class PathCommand : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), "path " + arguments); }
  std::filesystem::path file(const char* name) const { return folder_.path() / name; }
  ScratchFolder folder_;
};

TEST_F(PathCommand, writesTheSamePosesInBothFormatsAndGrindReadsBoth) {
  const std::string common = "--blade 3 --side concave --step-over 30 --pose-step 10 --retract 20 ";
  ASSERT_EQ(run(common + "--out path.csv").exit_code, 0);
  ASSERT_EQ(run(common + "--format apt --out path.cl").exit_code, 0);
  const std::vector<ToolMotion> table = readMotions(file("path.csv"));
  const std::vector<ToolMotion> cl = toolMotionsOf(readClFile(file("path.cl")));
  ASSERT_EQ(table.size(), cl.size());
  for (std::size_t k = 0; k < cl.size(); ++k) {
    EXPECT_EQ(table[k].feed, cl[k].feed);
    EXPECT_EQ(table[k].tool_in_blisk.translation, cl[k].tool_in_blisk.translation);
    EXPECT_LE((table[k].tool_in_blisk.rotation - cl[k].tool_in_blisk.rotation).norm(), 1e-14);
  }
  for (const char* path : {"path.csv", "path.cl"}) {
    const Outcome ground = runOctoblisk(
        folder_.path(), std::string("grind --ground-blade 3 --no-pictures --out run --path ") + path);
    EXPECT_LE(ground.exit_code, 1) << ground.error;
    EXPECT_THAT(ground.out, HasSubstr("ground blade 3 of 24"));
    EXPECT_THAT(ground.out, ::testing::Not(HasSubstr(" 0 intended contact"))) << ground.out;
  }
}

/// With this much tilt, the belt's strands also keep off it.
TEST_F(PathCommand, noPoseGougesTheBladeThatItGrinds) {
  for (const char* side : {"concave", "convex"}) {
    ASSERT_EQ(
        run(std::string("--blade 3 --step-over 30 --pose-step 8 --tilt 14 --out path.csv --side ") + side)
            .exit_code,
        0);
    ASSERT_LE(runOctoblisk(folder_.path(),
                           "grind --ground-blade 3 --poses-only --no-pictures --path path.csv --out run")
                  .exit_code,
              1);
    int touching = 0;
    for (const auto& row : readTable(file("run/poses.csv"))) {
      if (row.at("part") != "belt" || row.at("blade") != "3" || std::stod(row.at("depth_mm")) < 0.0) continue;
      ++touching;
      EXPECT_LE(std::stod(row.at("depth_mm")), 0.0205) << side << ", pose " << row.at("pose");
    }
    EXPECT_GT(touching, 20) << side;
  }
}

TEST_F(PathCommand, sixNumbersOfItsOwnPathGiveNearlyTheSamePoses) {
  ASSERT_EQ(run("--blade 3 --side convex --step-over 20 --lead 10 --retract 0 --out path.csv").exit_code, 0);
  const std::vector<ToolMotion> table = readMotions(file("path.csv"));
  ClFile six;
  for (const ToolMotion& motion : table) {
    six.motions.push_back(
        {motion.tool_in_blisk.translation, motion.tool_in_blisk.rotation.col(0), std::nullopt, 0.0, 1});
  }
  const auto tree = ClusteredOctree::build(std::make_shared<const TriangleMesh>(blisk().mesh));
  const std::vector<ToolMotion> completed = toolMotionsOf(six, tree);
  ASSERT_EQ(completed.size(), table.size());
  for (std::size_t k = 0; k < table.size(); ++k) {
    const double cosine =
        completed[k].tool_in_blisk.rotation.col(2).dot(table[k].tool_in_blisk.rotation.col(2));
    EXPECT_GT(cosine, std::cos(radians(6.0))) << k;
  }
}

TEST_F(PathCommand, followsABliskThatLiesAnywhere) {
  const Pose pose{Eigen::AngleAxisd(2.0, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                  {30.0, -400.0, 12.0}};
  std::vector<Vec3> vertices = blisk().mesh.vertices();
  for (Vec3& vertex : vertices) vertex = pose * vertex;
  const TriangleMesh mesh(vertices, blisk().mesh.triangles());
  writeMesh(file("moved.ply"), mesh);
  ASSERT_EQ(
      run("--blisk moved.ply --blade 2 --side leading --tilt 8 --wheel-width 0.01 --out path.csv").exit_code,
      0);
  const auto tree = ClusteredOctree::build(std::make_shared<const TriangleMesh>(mesh));
  int working = 0;
  for (const ToolMotion& motion : readMotions(file("path.csv"))) {
    if (motion.feed == 0.0) continue;
    ++working;
    const Vec3 contact = contactOf(motion.tool_in_blisk, {});
    EXPECT_LT(closestPoint(tree, contact).value().distance, 0.1) << "up to the lift by the facets";
  }
  EXPECT_GT(working, 20);
}

TEST_F(PathCommand, ofAClosedBliskTheArmLeavesByTheNearerEndOfTheChannel) {
  ASSERT_EQ(runOctoblisk(folder_.path(), "make blisk --triangles 10000 --shroud --out s.ply").exit_code, 0);
  for (const char* const side : {"convex", "leading"}) {
    ASSERT_EQ(
        run("--blisk s.ply --step-over 6 --pose-step 4 --out path.csv --side " + std::string(side)).exit_code,
        0);
    const double away = side == std::string("leading") ? -1.0 : 1.0;  // along the axis
    int working = 0, out = 0;
    for (const ToolMotion& motion : readMotions(file("path.csv"))) {
      if (motion.feed == 0.0) continue;
      ++working;
      out += away * motion.tool_in_blisk.rotation(2, 0) > 0.3;
    }
    EXPECT_GT(working, 50) << side;
    EXPECT_GT(out, working * 9 / 10) << side;
  }
}

TEST_F(PathCommand, writesAWholeFileOrNone) {
  folder_.write("path.csv", "as it was");
  EXPECT_EQ(run("--blade 25 --out path.csv").exit_code, 2);
  EXPECT_EQ(contentOf(file("path.csv")), "as it was");
  const Outcome refused = run("--step-over 40 --out missing/path.csv");
  EXPECT_EQ(refused.error,
            "octoblisk: missing/path.csv: cannot be written: the folder missing does not exist: create it\n");
  EXPECT_EQ(run("--step-over 40 --out /dev/null").exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null")) << "not a file that took its place";
}

TEST_F(PathCommand, refusesInOneLine) {
  for (const char* arguments :
       {"--blade 25 --out p.csv", "--blisk missing.stl --out p.csv", "--edge-margin 70 --out p.csv",
        "--out missing/p.csv", "--height-from 0.99 --out p.csv"}) {
    SCOPED_TRACE(arguments);
    expectRefusal(run(arguments), "");
  }
  for (const char* arguments :
       {"--side top --out p.csv", "--tilt 90 --out p.csv", "--step-over 0 --out p.csv",
        "--blade 0 --out p.csv", "--format step --out p.csv", ""}) {
    EXPECT_EQ(run(arguments).exit_code, 2) << arguments;
  }
}

}  // namespace
}  // namespace octoblisk::demos
