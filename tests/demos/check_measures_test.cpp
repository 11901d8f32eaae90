// octoblisk check: clearance, depth and the motions between poses.
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "demos/check_command.h"
#include "demos/refusal.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// The fields of a row of a table without quotes.
std::vector<std::string> fieldsOf(const std::string& row) {
  std::vector<std::string> fields;
  std::istringstream rest(row + ",");
  for (std::string each; std::getline(rest, each, ',');) fields.push_back(each);
  return fields;
}

/// Two boxes with edges 2 and 1, as OBJ files, and a path of the small one along x past and into the large
/// one.
void writeBoxes(const std::filesystem::path& folder) {
  for (const auto& [name, half] : {std::pair("large", 1.0), std::pair("small", 0.5)}) {
    writeMesh(folder / (std::string(name) + ".obj"), *octoblisk::testing::boxMesh({half, half, half}));
  }
}

/// A small cube wholly inside a solid, however the facets of both are given. It used to be called clear.
TEST_F(CheckCommand, doubledAndOverlappingMeshesAreSolids) {
  using octoblisk::testing::boxMesh;
  using octoblisk::testing::joined;
  using octoblisk::testing::moved;
  const auto large = boxMesh({1, 1, 1}), small = boxMesh({0.1, 0.1, 0.1}), twice = joined(*large, *large);
  const auto facet = octoblisk::testing::firstTriangles(*large, 1);
  const auto half = boxMesh({0.65, 1, 1});
  const auto shifted = [&](double x) { return moved(*half, Pose{Mat3::Identity(), Vec3(x, 0, 0)}); };
  const struct {
    const char* name;
    octoblisk::testing::SharedMesh fixed, moving;
    double clearance = 0.9;  // to the nearest facet, also to one inside the solid
  } cases[] = {{"one cube", large, small},
               {"every facet twice", twice, small},
               {"moving and fixed swapped", small, twice},
               {"three times", joined(*twice, *large), small},
               {"one facet twice", joined(*large, *facet), small},
               {"the moving one doubled", large, joined(*small, *small)},
               {"two boxes that overlap", joined(*shifted(-0.35), *shifted(0.35)), small, 0.2},
               {"nested, the same way", joined(*large, *boxMesh({0.5, 0.5, 0.5})), small, 0.4}};
  folder_.write("pose.csv", kPoseHeader + "0,0,0,1,0,0,0\n");
  for (const auto& [name, fixed, moving, clearance] : cases) {
    writeMesh(folder_.path() / "fixed.stl", *fixed);
    writeMesh(folder_.path() / "moving.stl", *moving);
    const Outcome outcome = run(
        "check --fixed fixed.stl --moving moving.stl --poses pose.csv --out - --clearance --depth --signed");
    EXPECT_EQ(outcome.exit_code, 1) << name;
    EXPECT_THAT(outcome.error, Not(HasSubstr("warning"))) << name;
    std::istringstream table(outcome.out);
    std::string header, row;
    std::getline(table, header);
    std::getline(table, row);
    const std::vector<std::string> fields = fieldsOf(row);
    ASSERT_GE(fields.size(), 7u) << name << ": " << outcome.out << outcome.error;
    EXPECT_EQ(fields[1], "0") << name;
    EXPECT_NEAR(std::stod(fields[4]), clearance, 2e-3) << name;
    EXPECT_NEAR(std::stod(fields[5]), 0.9, 2e-3) << name;
    EXPECT_NEAR(std::stod(fields[6]), -0.9, 2e-3) << name;
  }
}

TEST_F(CheckCommand, measuresClearanceDepthAndMotion) {
  writeBoxes(folder_.path());
  // Apart by 1, by 0.25, in by 0.3, wholly inside, then in one motion through the large one to the other
  // side.
  const std::string poses = kPoseHeader +
                            "2.5,0,0,1,0,0,0\n1.75,0,0,1,0,0,0\n1.2,0,0,1,0,0,0\n0.1,0,0,1,0,0,0\n" +
                            "2.5,0,0,1,0,0,0\n-2.5,0,0,1,0,0,0\n";
  folder_.write("poses.csv", poses);
  const std::string arguments =
      "check --fixed large.obj --moving small.obj --poses poses.csv --clearance --depth --continuous "
      "--tolerance "
      "0.001 --out ";
  const Outcome one = run(arguments + "one.csv --threads 1");
  EXPECT_EQ(one.exit_code, 1) << one.error;
  EXPECT_THAT(one.out,
              StartsWith("6 poses: 1 colliding, 1 with one mesh wholly inside the other, 4 clear; "));
  EXPECT_THAT(one.out, HasSubstr("\nLeast clearance: 0 at pose 2\n"));
  EXPECT_THAT(one.out, HasSubstr("\nGreatest depth: 0.6 at pose 3\n"));
  EXPECT_THAT(one.out,
              HasSubstr("\n5 motions between poses: 1 free, 4 not proved to keep 0.001 (4 come nearer, "));
  EXPECT_EQ(run(arguments + "three.csv --threads 3").exit_code, 1);
  EXPECT_EQ(contentOf(folder_.path() / "one.csv"), contentOf(folder_.path() / "three.csv"));

  std::istringstream table(contentOf(folder_.path() / "one.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "pose,colliding,triangle_fixed,triangle_moving,clearance,depth,fraction");
  const auto nothing = std::numeric_limits<double>::quiet_NaN();
  struct Row {
    bool colliding;
    double clearance, depth, fraction;
  };
  // The motions hit where the small box is within 0.001 … 0.001125 of the large one.
  const std::vector<Row> expected = {{false, 1.0, 0.0, nothing},     {false, 0.25, 0.0, 1.0},
                                     {true, 0.0, 0.3, 0.249 / 0.55}, {false, 0.4, 0.6, 0.0},
                                     {false, 1.0, 0.0, nothing},     {false, 1.0, 0.0, 0.999 / 5.0}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_TRUE(std::getline(table, line));
    const std::vector<std::string> fields = fieldsOf(line);
    ASSERT_EQ(fields.size(), 7u) << line;
    EXPECT_EQ(fields[1] == "1", expected[i].colliding) << line;
    EXPECT_NEAR(std::stod(fields[4]), expected[i].clearance, 1e-9) << line;
    EXPECT_NEAR(std::stod(fields[5]), expected[i].depth, 1e-3) << line;
    if (i == 4) continue;  // it leaves the large box: it hits, at a fraction that is not specified
    EXPECT_EQ(fields[6].empty(), std::isnan(expected[i].fraction)) << line;
    if (!fields[6].empty()) {
      EXPECT_NEAR(std::stod(fields[6]), expected[i].fraction, 5e-4) << line;
    }
  }
}

/// The boxes are askew, so that one pair of points is nearest. Which pair of triangles meets is free.
TEST_F(CheckCommand, answersDoNotDependOnTheWinding) {
  const auto expectSameMeasures = [&] {
    std::istringstream large(contentOf(folder_.path() / "large.csv")),
        mixed(contentOf(folder_.path() / "mixed.csv"));
    std::string of_large, of_mixed;
    std::getline(large, of_large);
    std::getline(mixed, of_mixed);
    EXPECT_EQ(of_large, of_mixed);
    for (int row = 0; row < 3; ++row) {
      ASSERT_TRUE(std::getline(large, of_large) && std::getline(mixed, of_mixed));
      const auto fields = fieldsOf(of_large), others = fieldsOf(of_mixed);
      ASSERT_EQ(fields.size(), others.size());
      for (std::size_t f = 0; f < fields.size(); ++f) {
        if (f == 2 || f == 3) continue;  // the triangles
        EXPECT_NEAR(std::stod(fields[f]), std::stod(others[f]), 1e-12) << row << ' ' << f;
      }
    }
  };
  writeBoxes(folder_.path());
  const auto box = octoblisk::testing::boxMesh({1, 1, 1});
  std::vector<TriangleMesh::Indices> triangles = box->triangles();
  for (TriangleMesh::Indices& corners : triangles) std::swap(corners[1], corners[2]);
  writeMesh(folder_.path() / "mixed.obj", {box->vertices(), std::move(triangles)});
  folder_.write(
      "poses.csv",
      kPoseHeader + "2.5,0,0,0.9,0.3,0.1,0.3\n1.2,0.1,0.2,0.9,0.3,0.1,0.3\n0.1,0,0,0.9,0.3,0.1,0.3\n");
  const std::string measures = " --moving small.obj --poses poses.csv --clearance --depth --signed --out ";
  EXPECT_EQ(run("check --fixed large.obj" + measures + "large.csv").exit_code, 1);
  EXPECT_EQ(run("check --fixed mixed.obj" + measures + "mixed.csv").exit_code, 1);
  expectSameMeasures();
  // The moving mesh too.
  const std::string moving =
      "check --fixed small.obj --poses poses.csv --clearance --depth --signed --moving ";
  EXPECT_EQ(run(moving + "large.obj --out large.csv").exit_code, 1);
  EXPECT_EQ(run(moving + "mixed.obj --out mixed.csv").exit_code, 1);
  expectSameMeasures();
}

TEST_F(CheckCommand, measuresTheSignedDistanceAndItsDerivative) {
  writeBoxes(folder_.path());
  // Above a corner region of the large box's top, rotated about z: apart by 0.25, in by 0.3, wholly inside.
  folder_.write("poses.csv", kPoseHeader + "0.2,0.1,1.75,1,0,0,0\n0.2,0.1,1.2,1,0,0,0\n0,0,0.45,1,0,0,0\n");
  const std::string arguments =
      "check --fixed large.obj --moving small.obj --poses poses.csv --signed --tolerance 1e-6 --out ";
  const Outcome one = run(arguments + "one.csv --threads 1");
  EXPECT_EQ(one.exit_code, 1) << one.error;
  EXPECT_THAT(one.out,
              StartsWith("3 poses: 1 colliding, 1 with one mesh wholly inside the other, 1 clear; "));
  EXPECT_THAT(one.out, HasSubstr("\nLeast signed distance: -0.95 at pose 2"));
  EXPECT_EQ(run(arguments + "three.csv --threads 3").exit_code, 1);
  EXPECT_EQ(contentOf(folder_.path() / "one.csv"), contentOf(folder_.path() / "three.csv"));
  std::istringstream table(contentOf(folder_.path() / "one.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line,
            "pose,colliding,triangle_fixed,triangle_moving,signed_distance,by_x,by_y,by_z,by_rx,by_ry,by_rz");
  for (const double expected : {0.25, -0.3}) {
    ASSERT_TRUE(std::getline(table, line));
    const std::vector<std::string> fields = fieldsOf(line);
    ASSERT_EQ(fields.size(), 11u) << line;
    EXPECT_NEAR(std::stod(fields[4]), expected, 1e-6);
    EXPECT_NEAR(std::stod(fields[7]), 1.0, 1e-6);
    EXPECT_NEAR(std::stod(fields[10]), 0.0, 1e-6);  // rotation about z changes nothing
  }
  writeMesh(folder_.path() / "sheet.obj", *octoblisk::testing::waveSheet(1, 0.1, 4));
  EXPECT_EQ(
      run("check --fixed sheet.obj --moving small.obj --poses poses.csv --signed --out out.csv").exit_code,
      1);
  expectRefusal(
      run("check --fixed sheet.obj --moving sheet.obj --poses poses.csv --signed --out two.csv"),
      "sheet.obj: signed distances need a closed mesh; the moving mesh is open and so is this one: 16 of its "
      "edges are open");
}

TEST_F(CheckCommand, aMeshInsideAnotherIsFoundByItsDepthAlone) {
  writeBoxes(folder_.path());
  folder_.write("poses.csv", kPoseHeader + "0.1,0,0,1,0,0,0\n");
  const std::string large_round_small = "check --poses poses.csv --out out.csv --fixed ";
  for (const std::string meshes : {"large.obj --moving small.obj", "small.obj --moving large.obj"}) {
    const Outcome without = run(large_round_small + meshes);
    EXPECT_EQ(without.exit_code, 0);
    EXPECT_THAT(without.out, StartsWith("1 pose: 0 colliding, 1 clear; "));
    const Outcome with = run(large_round_small + meshes + " --depth");
    EXPECT_EQ(with.exit_code, 1);
    EXPECT_THAT(with.out,
                StartsWith("1 pose: 0 colliding, 1 with one mesh wholly inside the other, 0 clear"));
  }
}

TEST_F(CheckCommand, freeWaysAreCleanAndThoseThatAreNotAreNoCleanRun) {
  writeBoxes(folder_.path());
  const std::string arguments =
      "check --fixed large.obj --moving small.obj --continuous --out out.csv --poses ";
  folder_.write("past.csv", kPoseHeader + "2.5,0,0,1,0,0,0\n2.5,3,0,1,0,0,0\n");
  const Outcome past = run(arguments + "past.csv");
  EXPECT_EQ(past.exit_code, 0);
  EXPECT_THAT(past.out, HasSubstr("1 motion between poses: 1 free, 0 not proved to keep 0.001\n"));
  EXPECT_THAT(contentOf(folder_.path() / "out.csv"), HasSubstr("\n0,0,,,\n1,0,,,1\n"));
  folder_.write("through.csv", kPoseHeader + "2.5,0,0,1,0,0,0\n-2.5,0,0,1,0,0,0\n");
  const Outcome through = run(arguments + "through.csv");
  EXPECT_EQ(through.exit_code, 1) << "both poses are clear, the motion is not";
  EXPECT_THAT(through.out, StartsWith("2 poses: 0 colliding, 2 clear; "));
}

TEST_F(CheckCommand, depthsNeedAClosedMesh) {
  writeBoxes(folder_.path());
  writeMesh(folder_.path() / "sheet.obj", *octoblisk::testing::waveSheet(1, 0.1, 4));
  folder_.write("poses.csv", kPoseHeader + "0,0,0,1,0,0,0\n");
  const Outcome outcome =
      run("check --fixed sheet.obj --moving small.obj --poses poses.csv --depth --out out.csv");
  expectRefusal(outcome, "sheet.obj: depths need a closed fixed mesh, but 16 of its edges are open");
  EXPECT_THAT(outcome.error,
              HasSubstr("unless it may be inside the fixed one, swap the two meshes and invert each pose"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out.csv"));
  const Outcome swapped =
      run("check --fixed small.obj --moving sheet.obj --poses poses.csv --depth --out out.csv");
  EXPECT_EQ(swapped.exit_code, 1);
  EXPECT_THAT(swapped.error,
              HasSubstr("sheet.obj: the mesh has holes: a mesh inside it near them may be missed"));
}

/// A box inside a sphere with a pinhole, either of them moving; and inside half a sphere, a bowl.
TEST_F(CheckCommand, noticesAMeshInsideAnotherFarFromItsHoles) {
  std::mt19937_64 random(64);
  const auto sphere = octoblisk::testing::bumpySphere(random, 3.0, 0.0, 24);
  const auto writePart = [&](const std::string& name, std::size_t without) {
    writeMesh(folder_.path() / name,
              *octoblisk::testing::firstTriangles(*sphere, sphere->triangleCount() - without));
  };
  writePart("pinhole.obj", 1);
  writePart("bowl.obj", sphere->triangleCount() / 2);
  writeMesh(folder_.path() / "box.obj", *octoblisk::testing::boxMesh({0.5, 0.5, 0.5}));
  folder_.write("poses.csv", kPoseHeader + "0,0,0,1,0,0,0\n");
  const std::string rest = " --poses poses.csv --out out.csv";
  const auto signOf = [&] {
    const std::string out = contentOf(folder_.path() / "out.csv");
    return out.substr(out.find("\n0,0,,,") + 7, 1);
  };
  EXPECT_EQ(run("check --fixed box.obj --moving pinhole.obj --depth" + rest).exit_code, 1);
  EXPECT_EQ(run("check --fixed box.obj --moving bowl.obj --depth" + rest).exit_code, 0);
  EXPECT_EQ(run("check --fixed pinhole.obj --moving box.obj --signed" + rest).exit_code, 1);
  EXPECT_EQ(signOf(), "-");
  EXPECT_EQ(run("check --fixed bowl.obj --moving box.obj --signed" + rest).exit_code, 0);
  EXPECT_NE(signOf(), "-");
}

/// Where they overlap, the winding number is 0, and nothing is inside.
TEST_F(CheckCommand, warnsOfPartsThatFaceOppositeWays) {
  const TriangleMesh box = *octoblisk::testing::boxMesh({5, 5, 5});
  const TriangleMesh other =
      *octoblisk::testing::insideOut(*octoblisk::testing::moved(box, {Mat3::Identity(), Vec3(5, 5, 5)}));
  writeMesh(folder_.path() / "parts.obj", *octoblisk::testing::joined(box, other));
  writeMesh(folder_.path() / "hollow.obj",
            *octoblisk::testing::joined(
                box, *octoblisk::testing::insideOut(*octoblisk::testing::boxMesh({4, 4, 4}))));
  writeMesh(folder_.path() / "small.obj", *octoblisk::testing::boxMesh({0.1, 0.1, 0.1}));
  folder_.write("poses.csv", kPoseHeader + "2.5,2.5,2.5,1,0,0,0\n");
  const std::string rest = " --poses poses.csv --depth --out out.csv";
  const std::string kWarning =
      "parts.obj: 12 of its triangles face inward, the first number 12: where parts that face opposite ways "
      "overlap, nothing is inside";
  EXPECT_THAT(run("check --fixed parts.obj --moving small.obj" + rest).error, HasSubstr(kWarning));
  EXPECT_THAT(run("check --fixed small.obj --moving parts.obj" + rest).error, HasSubstr(kWarning));
  EXPECT_EQ(run("check --fixed hollow.obj --moving small.obj" + rest).error, "");
}

}  // namespace
}  // namespace octoblisk::demos
