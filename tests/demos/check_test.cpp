// octoblisk check, run as its users run it: the real executable, in a folder of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "models/mesh_file.h"
#include "octoblisk/contact.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kPi = std::numbers::pi;
const std::string kPoseHeader = "x,y,z,qw,qx,qy,qz\n";
/// So few stations follow the wheels less closely: they need a wider gap, mm.
const std::string kCoarseBelt = " --stations 96 --points-per-station 16 --wheel-gap 0.2";

/// One line of a result file.
struct Answer {
  bool colliding = false;
  TrianglePair pair;  ///< where colliding
};

/// Reads a result file and checks its form.
std::vector<Answer> readAnswers(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line, "pose,colliding,triangle_fixed,triangle_moving");
  std::vector<Answer> answers;
  while (std::getline(stream, line)) {
    const std::string pose = std::to_string(answers.size());
    Answer answer;
    if (line != pose + ",0,,") {
      std::istringstream rest(line);
      char comma = 0;
      rest.ignore(static_cast<std::streamsize>(pose.size() + 3));
      rest >> answer.pair.a >> comma >> answer.pair.b;
      answer.colliding = true;
      EXPECT_EQ(line, pose + ",1," + std::to_string(answer.pair.a) + "," + std::to_string(answer.pair.b));
    }
    answers.push_back(answer);
  }
  return answers;
}

/// The belt's frame in the default blisk's: at the angle (radians) and height about its axis, the contact
/// wheel's centre `radius` from it, the arm outwards but for small turns (radians, about its own axes).
/// Lengths in mm.
Pose beltPose(double angle, double radius, double height, const Vec3& turns = Vec3::Zero()) {
  const Mat3 outwards = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  const double turn = turns.norm();
  const Vec3 axis = turn > 0.0 ? Vec3(turns / turn) : Vec3::UnitX();
  return {outwards * Eigen::AngleAxisd(turn, axis).toRotationMatrix(), outwards * Vec3(radius, 0.0, height)};
}

/// Poses of the belt round the default blisk's blades, of radii 128 … 240 mm.
std::vector<Pose> posesRoundBlades(int count) {
  std::mt19937_64 random(2024);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double angle = between(-kPi, kPi), radius = between(225.0, 260.0), height = between(-60.0, 60.0);
    const double roll = between(-kPi, kPi), tilt = between(-0.4, 0.4), swing = between(-0.4, 0.4);
    poses.push_back(beltPose(angle, radius, height, {roll, tilt, swing}));
  }
  return poses;
}

/// The triangles that reach into the box, and their indices in the whole mesh.
struct Cutout {
  std::vector<std::uint32_t> indices;
  std::vector<Triangle> triangles;

  Cutout(const TriangleMesh& mesh, const Pose& pose, const Aabb& box) {
    for (std::uint32_t i = 0; i < mesh.triangleCount(); ++i) {
      const Triangle posed = pose * mesh.triangle(i);
      Aabb bounds;
      for (const Vec3& corner : posed) bounds.extend(corner);
      if ((bounds.min.array() > box.max.array()).any() || (box.min.array() > bounds.max.array()).any())
        continue;
      indices.push_back(i);
      triangles.push_back(mesh.triangle(i));
    }
  }

  Aabb bounds(const Pose& pose) const {
    Aabb result;
    for (const Triangle& triangle : triangles) {
      for (const Vec3& corner : triangle) result.extend(pose * corner);
    }
    return result;
  }

  TriangleMesh mesh() const {
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Indices> corners;
    for (const Triangle& triangle : triangles) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      vertices.insert(vertices.end(), triangle.begin(), triangle.end());
      corners.push_back({first, first + 1, first + 2});
    }
    return {vertices, corners};
  }
};

/// All pairs of triangles that meet: those of bruteForcePairs over all triangles, for which only the ones in
/// the other mesh's bounds come into question.
std::vector<TrianglePair> pairsThatMeet(const TriangleMesh& fixed, const TriangleMesh& moving,
                                        const Pose& pose) {
  const Cutout in_moving(moving, pose, fixed.bounds());
  const Cutout in_fixed(fixed, Pose{}, in_moving.bounds(pose));
  if (in_moving.indices.empty() || in_fixed.indices.empty()) return {};
  std::vector<TrianglePair> pairs = testing::bruteForcePairs(in_fixed.mesh(), in_moving.mesh(), pose);
  for (TrianglePair& pair : pairs) pair = {in_fixed.indices[pair.a], in_moving.indices[pair.b]};
  return pairs;
}

class CheckCommand : public ::testing::Test {
 protected:
  /// Runs `octoblisk` in the scratch folder.
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), arguments); }

  void make(const std::string& arguments) {
    const Outcome made = run("make " + arguments);
    ASSERT_EQ(made.exit_code, 0) << made.error;
  }

  void makeMeshes(const std::string& extension) {
    make("blisk --triangles 10000 --out blisk" + extension);
    make("belt" + kCoarseBelt + " --out belt" + extension);
  }

  Outcome check(const std::string& extension, const std::string& poses, const std::string& out) {
    return run("check --fixed blisk" + extension + " --moving belt" + extension + " --poses " + poses +
               " --out " + out);
  }

  TriangleMesh mesh(const std::string& name) { return readMesh(folder_.path() / name); }

  /// Exit code 2, and one line that begins with the place.
  void expectRefused(const std::string& arguments, const std::string& place) {
    const Outcome outcome = run("check " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
    EXPECT_THAT(outcome.error, StartsWith("octoblisk: " + place)) << arguments;
  }

  ScratchFolder folder_;
};

TEST_F(CheckCommand, SaysWhatBruteForceSaysInEveryFormat) {
  constexpr int kPoses = 300;
  constexpr double kLeastHits = 0.3, kMostHits = 0.7;
  writePoses(folder_.path() / "poses.csv", posesRoundBlades(kPoses));
  const std::vector<Pose> poses = readPoses(folder_.path() / "poses.csv");
  makeMeshes(".stl");
  const TriangleMesh blisk = mesh("blisk.stl"), belt = mesh("belt.stl");

  std::vector<std::vector<TrianglePair>> truth;
  for (const Pose& pose : poses) truth.push_back(pairsThatMeet(blisk, belt, pose));
  const auto hits = kPoses - std::ranges::count(truth, true, &std::vector<TrianglePair>::empty);
  EXPECT_GE(hits, kLeastHits * kPoses);
  EXPECT_LE(hits, kMostHits * kPoses);

  for (const std::string extension : {".stl", ".ply", ".obj"}) {
    SCOPED_TRACE(extension);
    makeMeshes(extension);
    for (const auto& [read, expected] :
         {std::pair{mesh("blisk" + extension), &blisk}, {mesh("belt" + extension), &belt}}) {
      ASSERT_EQ(read.triangleCount(), expected->triangleCount());
      for (std::size_t i = 0; i < read.triangleCount(); ++i)
        ASSERT_EQ(read.triangle(i), expected->triangle(i)) << i;
    }
    const Outcome outcome = check(extension, "poses.csv", "result.csv");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.error, "");
    EXPECT_THAT(outcome.out, StartsWith("300 poses: " + std::to_string(hits) + " colliding, " +
                                        std::to_string(kPoses - hits) + " clear; "));
    EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 1);
    const std::vector<Answer> answers = readAnswers(folder_.path() / "result.csv");
    ASSERT_EQ(answers.size(), poses.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
      EXPECT_EQ(answers[i].colliding, !truth[i].empty()) << "pose " << i;
      if (!answers[i].colliding) continue;
      EXPECT_THAT(truth[i], Contains(answers[i].pair)) << "pose " << i;
    }
  }
}

TEST_F(CheckCommand, BruteForceOfTheTestItselfLooksAtEveryTriangle) {
  makeMeshes(".stl");
  const TriangleMesh blisk = mesh("blisk.stl"), belt = mesh("belt.stl");
  for (const Pose& pose : posesRoundBlades(3)) {
    EXPECT_EQ(pairsThatMeet(blisk, belt, pose), testing::bruteForcePairs(blisk, belt, pose));
  }
}

std::string textOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Two boxes of edges 2 and 1, as OBJ files, and a way of the small one along x past and into the large one.
void writeBoxes(const std::filesystem::path& folder) {
  for (const auto& [name, half] : {std::pair("large", 1.0), std::pair("small", 0.5)}) {
    writeMesh(folder / (std::string(name) + ".obj"), *octoblisk::testing::boxMesh({half, half, half}));
  }
}

TEST_F(CheckCommand, TellsClearanceDepthAndTheWayBetween) {
  writeBoxes(folder_.path());
  // Apart by 1, by 0.25, in by 0.3, wholly inside, then through the large one to the other side at a stroke.
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
  EXPECT_EQ(run(arguments + "three.csv --threads 3").exit_code, 1);
  EXPECT_EQ(textOf(folder_.path() / "one.csv"), textOf(folder_.path() / "three.csv"));

  std::istringstream table(textOf(folder_.path() / "one.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "pose,colliding,triangle_fixed,triangle_moving,clearance,depth,fraction");
  const auto nothing = std::numeric_limits<double>::quiet_NaN();
  struct Row {
    bool colliding;
    double clearance, depth, fraction;
  };
  // The ways meet where the small box is within 0.001 … 0.001125 of the large one.
  const std::vector<Row> expected = {{false, 1.0, 0.0, nothing},     {false, 0.25, 0.0, nothing},
                                     {true, 0.0, 0.3, 0.249 / 0.55}, {false, 0.4, 0.6, 0.0},
                                     {false, 1.0, 0.0, nothing},     {false, 1.0, 0.0, 0.999 / 5.0}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_TRUE(std::getline(table, line));
    std::vector<std::string> fields;
    std::istringstream rest(line + ",");
    for (std::string each; std::getline(rest, each, ',');) fields.push_back(each);
    ASSERT_EQ(fields.size(), 7u) << line;
    EXPECT_EQ(fields[1] == "1", expected[i].colliding) << line;
    EXPECT_NEAR(std::stod(fields[4]), expected[i].clearance, 1e-9) << line;
    EXPECT_NEAR(std::stod(fields[5]), expected[i].depth, 1e-3) << line;
    if (i == 4) continue;  // out of the large box again: met on the way, wherever that is proved
    EXPECT_EQ(fields[6].empty(), std::isnan(expected[i].fraction)) << line;
    if (!fields[6].empty()) {
      EXPECT_NEAR(std::stod(fields[6]), expected[i].fraction, 5e-4) << line;
    }
  }
}

TEST_F(CheckCommand, DepthsNeedAClosedMesh) {
  writeBoxes(folder_.path());
  writeMesh(folder_.path() / "sheet.obj", *octoblisk::testing::waveSheet(1, 0.1, 4));
  folder_.write("poses.csv", kPoseHeader + "0,0,0,1,0,0,0\n");
  const Outcome outcome =
      run("check --fixed sheet.obj --moving small.obj --poses poses.csv --depth --out out.csv");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.error, HasSubstr("sheet.obj: depths need a closed mesh"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out.csv"));
  EXPECT_EQ(
      run("check --fixed small.obj --moving sheet.obj --poses poses.csv --depth --out out.csv").exit_code, 1);
}

TEST_F(CheckCommand, LeavesZeroForACleanPath) {
  constexpr int kPoses = 90;
  constexpr double kClearRadius = 300.0;  // mm; the tips are at 240
  std::vector<Pose> poses;
  for (int i = 0; i < kPoses; ++i) poses.push_back(beltPose(2.0 * kPi * i / kPoses, kClearRadius, 0.0));
  writePoses(folder_.path() / "poses.csv", poses);
  makeMeshes(".stl");
  const Outcome outcome = check(".stl", "poses.csv", "result.csv");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(outcome.error, "");
  EXPECT_THAT(outcome.out, HasSubstr("90 poses: 0 colliding, 90 clear"));
  const std::vector<Answer> answers = readAnswers(folder_.path() / "result.csv");
  EXPECT_EQ(answers.size(), poses.size());
  EXPECT_TRUE(std::ranges::none_of(answers, &Answer::colliding));
}

class CheckRefusal : public CheckCommand {
 protected:
  void SetUp() override {
    makeMeshes(".stl");
    folder_.write("poses.csv", kPoseHeader + "0,0,0,1,0,0,0\n");
  }

  void expectMeshRefused(const std::string& name) {
    expectRefused("--fixed " + name + " --moving belt.stl --poses poses.csv --out result.csv", name);
    expectRefused("--fixed blisk.stl --moving " + name + " --poses poses.csv --out result.csv", name);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "result.csv"));
  }

  void expectPosesRefused(const std::string& content, const std::string& line) {
    folder_.write("bad.csv", content);
    expectRefused("--fixed blisk.stl --moving belt.stl --poses bad.csv --out result.csv",
                  "bad.csv:" + line + ": ");
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "result.csv"));
  }

  void expectOutRefused(const std::string& name) {
    expectRefused("--fixed blisk.stl --moving belt.stl --poses poses.csv --out " + name, name + ": ");
  }
};

TEST_F(CheckRefusal, OfBadMeshesNamesThem) {
  expectMeshRefused("missing.stl");
  folder_.write("mesh.step", "no mesh");
  expectMeshRefused("mesh.step");
  for (const std::string extension : {".stl", ".ply", ".obj"}) {
    folder_.write("empty" + extension, "");
    expectMeshRefused("empty" + extension);
    make("belt" + kCoarseBelt + " --out whole" + extension);
    const std::string whole = contentOf(folder_.path() / ("whole" + extension));
    folder_.write("truncated" + extension, whole.substr(0, whole.size() - 7));
    expectMeshRefused("truncated" + extension);
  }
}

TEST_F(CheckRefusal, OfBadPosesNamesFileAndLine) {
  const std::string good = "0,0,0,1,0,0,0\n";
  expectPosesRefused("", "1");
  expectPosesRefused("x,y,z,qx,qy,qz,qw\n" + good, "1");
  expectPosesRefused(kPoseHeader + good + "nan,0,0,1,0,0,0\n", "3");
  expectPosesRefused(kPoseHeader + good + good + "0,0,0,1,0,0\n", "4");
  expectPosesRefused(kPoseHeader + "0,0,0,0,0,0,0\n" + good, "2");
  expectPosesRefused(kPoseHeader + "0,0,0,one,0,0,0\n", "2");
  expectRefused("--fixed blisk.stl --moving belt.stl --poses missing.csv --out result.csv",
                "missing.csv: no such file");
  expectRefused("--fixed blisk.stl --moving belt.stl --poses . --out result.csv", ".: this is a folder");
  expectRefused("--fixed . --moving belt.stl --poses poses.csv --out result.csv", ".: this is a folder");
  expectRefused("--fixed blisk.stl --moving belt.stl --poses belt.stl --out result.csv",
                "belt.stl:1: the file is binary");
  folder_.write("none.csv", kPoseHeader);
  expectRefused("--fixed blisk.stl --moving belt.stl --poses none.csv --out result.csv", "none.csv: ");
}

TEST_F(CheckRefusal, OfAResultThatCannotBeWrittenNamesIt) {
  expectOutRefused("missing/result.csv");
  expectOutRefused(".");
  if (std::filesystem::exists("/dev/full")) expectOutRefused("/dev/full");
  const std::string poses = contentOf(folder_.path() / "poses.csv");
  expectOutRefused("./poses.csv");
  EXPECT_EQ(contentOf(folder_.path() / "poses.csv"), poses) << "input is never written over";
}

TEST_F(CheckRefusal, OfOptionsItDoesNotKnow) {
  const std::string good = "check --fixed blisk.stl --moving belt.stl --poses poses.csv ";
  for (const std::string& arguments :
       {good + "--out result.csv --blades 3", good, std::string("check"), std::string("")}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_THAT(std::ranges::count(outcome.error, '\n'), ::testing::AllOf(::testing::Ge(1), ::testing::Le(2)))
        << outcome.error;
  }
  EXPECT_THAT(run(good + "--out result.csv --blades 3").error, HasSubstr("--blades"));
}

TEST_F(CheckCommand, AnUnknownSubcommandIsNamedWithTheNearest) {
  const auto refusal = [&](const std::string& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
    return outcome.error;
  };
  EXPECT_EQ(refusal("chek --fixed a"),
            "octoblisk: 'chek' is no subcommand; did you mean 'check'? There are: grind, make, check\n");
  EXPECT_THAT(refusal("make contact_wheel"), HasSubstr("did you mean 'contact-wheel'?"));
  EXPECT_EQ(refusal("polish"), "octoblisk: 'polish' is no subcommand; there are: grind, make, check\n");
}

TEST_F(CheckCommand, SizesAreBoundedAndTheMessageIsShort) {
  const std::pair<std::string, std::string> cases[] = {
      {"make belt --stations 2e9", "--stations: '2e9' is no whole number from 16 to 100000"},
      {"make belt --stations 2000000000", "--stations: '2000000000' is no whole number from 16 to 100000"},
      {"make arm --stations 100000 --points-per-station 100000", "octoblisk: stations times points"},
      {"make belt --width nan", "--width: 'nan' is no number from -100000 to 100000"},
      {"make blisk --section-count 1000000", "--section-count: '1000000' is no whole number from 2 to 1000"},
      {"make blisk --triangles 100000000", "--triangles: '100000000' is no whole number from 1 to 10000000"},
      {"make blisk --tip-radius 1e300", "--tip-radius: '1e300' is no number"},
      {"make blisk --shroud-thickness 3", "--shroud-thickness requires --shroud"},
      {"make blisk --shroud-overhang 3", "--shroud-overhang requires --shroud"}};
  for (const auto& [arguments, message] : cases) {
    const Outcome outcome = run(arguments + " --out made.stl");
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.error, StartsWith(message)) << arguments;
    EXPECT_LT(outcome.error.find('\n'), 90u) << outcome.error;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "made.stl")) << arguments;
  }
  EXPECT_THAT(run("make arm --out ''").error, StartsWith("--out: the name is empty"));
  make("blisk --triangles 20000 --shroud --shroud-thickness 3 --lean=-1 --out made.stl");
}

TEST_F(CheckCommand, Helps) {
  for (const std::string arguments : {"--help", "check --help", "make blisk --help"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments;
    EXPECT_EQ(outcome.error, "") << arguments;
    EXPECT_NE(outcome.out, "") << arguments;
  }
  EXPECT_THAT(run("check --help").out, HasSubstr("mesh units"));
}

}  // namespace
}  // namespace octoblisk::demos
