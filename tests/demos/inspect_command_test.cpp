// octoblisk inspect: its text, JSON, pictures and exit codes, and the meshes that it closes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "demos/block.h"
#include "demos/command.h"
#include "demos/refusal.h"
#include "demos/scratch_folder.h"
#include "io/mesh_file.h"
#include "octoblisk/mass_properties.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class InspectCommand : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), "inspect " + arguments); }
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

  /// Writes a block of 20 x 10 x 4 without the triangles that have all corners where `is_gone` is true.
  template <typename IsGone>
  void writeBlockWithout(const std::string& name, const IsGone& is_gone) {
    const TriangleMesh whole = block({10, 5, 2}, 2);
    std::vector<TriangleMesh::Indices> kept;
    for (std::size_t t = 0; t < whole.triangleCount(); ++t) {
      if (!std::ranges::all_of(whole.triangle(t), is_gone)) kept.push_back(whole.triangles()[t]);
    }
    writeMesh(file(name), {whole.vertices(), kept});
  }

  static bool isOnTop(const Vec3& v) { return v.z() == 2.0; }
  static bool isAtAnEdge(const Vec3& v) { return v.z() + v.x() / 5.0 > 1.9; }

  ScratchFolder folder_;
};

TEST_F(InspectCommand, saysThatAMeshIsASolid) {
  writeMesh(file("block.stl"), block({10, 5, 2}, 2));
  const Outcome outcome = run("block.stl");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.out,
            "block.stl: 48 triangles in 1 component: 1 shell; 20 x 10 x 4\n"
            "The mesh bounds a solid and faces outward\n"
            "Depth:   known everywhere\n"
            "Inertia: exact; volume 800\n"
            "Margin:  in Bullet, bodies rest on a thin margin and are pushed out of the solid\n");
}

TEST_F(InspectCommand, resultsAreInMillimetresOnRequest) {
  writeMesh(file("block.stl"), block({0.25, 0.125, 0.5}, 2));
  const Outcome outcome = run("block.stl --units m");
  EXPECT_THAT(outcome.out, HasSubstr("500 x 250 x 1000 mm\n"));
  EXPECT_THAT(outcome.out, HasSubstr("exact; volume 1.25e+08 mm³\n"));
  writeBlockWithout("open.stl", isOnTop);
  const Outcome closed = run("open.stl --units m --close closed.stl");
  EXPECT_EQ(closed.exit_code, 0);
  EXPECT_THAT(closed.out, HasSubstr("area 2e+08 mm²\n"));
  EXPECT_EQ(readMesh(file("closed.stl")).bounds().max, Vec3(10, 5, 2)) << "in the unit of the input";
}

TEST_F(InspectCommand, namesEachDefectWithItsFirstPlace) {
  TriangleMesh doubled = block({10, 5, 2}, 2);
  std::vector<TriangleMesh::Indices> triangles = doubled.triangles();
  triangles.push_back(triangles[3]);
  const TriangleMesh other = moved(block({10, 5, 2}, 2), {1, 1, 1});
  writeMesh(file("mesh.ply"), joined({doubled.vertices(), triangles}, other));
  const Outcome outcome = run("mesh.ply");
  EXPECT_EQ(outcome.exit_code, 0) << "these defects change nothing";
  EXPECT_THAT(outcome.out, HasSubstr("\nOf no consequence:\n"));
  EXPECT_THAT(outcome.out, HasSubstr("  copies of other triangles "));
  EXPECT_THAT(outcome.out, HasSubstr("  1  triangle 48 at ("));
  EXPECT_THAT(outcome.out, HasSubstr("  triangles that intersect or overlap "));
  EXPECT_THAT(outcome.out, Not(HasSubstr("\nDefects:\n")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("T-junctions")));
}

TEST_F(InspectCommand, closesPlanarHoles) {
  writeBlockWithout("open.stl", isOnTop);
  const Outcome open = run("open.stl");
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_THAT(open.out, HasSubstr("\nDefects:\n  open edges around a hole "));
  EXPECT_THAT(open.out, HasSubstr("at (0 0 2), planar, area 200\n"));
  EXPECT_THAT(open.out, HasSubstr("\nInertia: that of the bounding box\n"));
  const Outcome closed = run("open.stl --close closed.ply");
  EXPECT_EQ(closed.exit_code, 0) << "of the new mesh";
  EXPECT_THAT(closed.out, HasSubstr("\nClosed: the hole with 8 edges at (0 0 2), by 6 triangles\n"));
  EXPECT_THAT(closed.out, HasSubstr("\nclosed.ply: the new mesh bounds a solid and faces outward\n"));
  EXPECT_EQ(run("closed.ply").exit_code, 0);
  EXPECT_NEAR(massProperties(readMesh(file("closed.ply"))).volume, 800.0, 1e-3);
  const Outcome again = run("closed.ply --close again.ply");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.out, HasSubstr("\nNo holes: nothing was added\n"));
}

TEST_F(InspectCommand, refusesHolesThatAreNotPlanar) {
  writeBlockWithout("open.stl", isAtAnEdge);
  const Outcome outcome = run("open.stl --close rest.stl");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("\nRefused: the hole with "));
  EXPECT_THAT(outcome.out, HasSubstr(": it is not planar, its corners are up to "));
  EXPECT_EQ(readMesh(file("rest.stl")).triangleCount(), readMesh(file("open.stl")).triangleCount());
}

TEST_F(InspectCommand, printsJson) {
  writeBlockWithout("open.stl", isOnTop);
  const Outcome outcome = run("open.stl --json --close closed.stl --picture open.png");
  EXPECT_EQ(outcome.exit_code, 0);
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json.at("file"), "open.stl");
  EXPECT_EQ(json.at("triangles"), 40);
  EXPECT_EQ(json.at("is_solid"), false);
  EXPECT_EQ(json.at("is_closed"), false);
  EXPECT_TRUE(json.at("volume").is_null());
  EXPECT_THAT(json.at("why_not_solid").get<std::string>(), StartsWith("The mesh has a hole with 8 edges"));
  ASSERT_EQ(json.at("holes").size(), 1u);
  EXPECT_EQ(json.at("holes")[0].at("edges"), 8);
  EXPECT_EQ(json.at("holes")[0].at("is_planar"), true);
  EXPECT_EQ(json.at("holes")[0].at("area"), 200.0);
  EXPECT_EQ(json.at("copies").at("count"), 0);
  EXPECT_GT(json.at("sheets").at("count"), 0);
  EXPECT_EQ(json.at("sheets").at("first").size(), std::min<std::size_t>(10, json.at("sheets").at("count")));
  const nlohmann::json& closed = json.at("closed");
  EXPECT_EQ(closed.at("is_solid"), true);
  EXPECT_NEAR(closed.at("volume").get<double>(), 800.0, 1e-9);
  EXPECT_EQ(closed.at("added").size(), 1u);
  EXPECT_EQ(closed.at("refused").size(), 0u);
  EXPECT_TRUE(contentOf(file("open.png")).starts_with("\x89PNG"));
}

TEST_F(InspectCommand, drawsEachKindOfDefect) {
  const TriangleMesh whole = block({10, 5, 2}, 2);
  std::vector<TriangleMesh::Indices> turned = whole.triangles();
  for (TriangleMesh::Indices& corners : turned) std::swap(corners[0], corners[1]);
  writeMesh(file("mesh.ply"), joined(joined(whole, moved(whole, {1, 1, 1})),
                                     joined(moved({whole.vertices(), turned}, {40, 0, 0}),
                                            moved(*octoblisk::testing::waveSheet(5, 1, 4), {0, 30, 0}))));
  const Outcome outcome = run("mesh.ply --picture mesh.png");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out,
              HasSubstr("The mesh bounds a solid and faces inward in parts, except around a hole: the "
                        "triangles there are sheets\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nPicture: mesh.png\n"));
  EXPECT_TRUE(contentOf(file("mesh.png")).starts_with("\x89PNG"));
}

TEST_F(InspectCommand, saysWhatASheetIs) {
  writeMesh(file("sheet.obj"), *octoblisk::testing::waveSheet(1, 0.1, 4));
  const Outcome outcome = run("sheet.obj");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("\nThe mesh is an open surface with a hole: it bounds no solid\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nDepth:   none: nothing is inside the mesh\n"));
}

TEST_F(InspectCommand, refusesBadInput) {
  expectRefusal(run("missing.stl"), "missing.stl");
  folder_.write("text.stl", "no mesh");
  expectRefusal(run("text.stl"), "text.stl");
  writeBlockWithout("open.stl", isOnTop);
  expectRefusal(run("open.stl --close open.stl"), "open.stl");
  expectRefusal(run("open.stl --close closed.txt"), ": closed.txt: unknown mesh format '.txt'");
  expectRefusal(run("open.stl --units km"), "--units");
  expectRefusal(run(""), "MESH is required");
  EXPECT_FALSE(std::filesystem::exists(file("closed.txt")));
}

}  // namespace
}  // namespace octoblisk::demos
