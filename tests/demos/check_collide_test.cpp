// octoblisk check: whether surfaces meet, and which triangles.
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "demos/check_command.h"
#include "octoblisk/contact.h"
#include "shared/brute_force.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// One line of a result file.
struct Answer {
  bool colliding = false;
  TrianglePair pair;  ///< if colliding
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

/// The belt's frame in the default blisk's frame: at an angle (radians) and height about its axis, with the
/// contact wheel's centre at `radius`, and the arm outwards except for small turns (radians, about its own
/// axes). Lengths in mm.
Pose beltPose(double angle, double radius, double height, const Vec3& turns = Vec3::Zero()) {
  const Mat3 outwards = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  const double turn = turns.norm();
  const Vec3 axis = turn > 0.0 ? Vec3(turns / turn) : Vec3::UnitX();
  return {outwards * Eigen::AngleAxisd(turn, axis).toRotationMatrix(), outwards * Vec3(radius, 0.0, height)};
}

/// Poses of the belt around the default blisk's blades, whose radii are 128 … 240 mm.
std::vector<Pose> posesRoundBlades(int count) {
  std::mt19937_64 random(2024);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double angle = between(-std::numbers::pi, std::numbers::pi), radius = between(225.0, 260.0),
                 height = between(-60.0, 60.0);
    const double roll = between(-std::numbers::pi, std::numbers::pi), tilt = between(-0.4, 0.4),
                 swing = between(-0.4, 0.4);
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
      if (!box.meets(boundsOf(posed))) continue;
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

/// All triangle pairs that meet: those of bruteForcePairs over all triangles, restricted to the triangles in
/// the other mesh's bounds, because no others can meet.
std::vector<TrianglePair> pairsThatMeet(const TriangleMesh& fixed, const TriangleMesh& moving,
                                        const Pose& pose) {
  const Cutout in_moving(moving, pose, fixed.bounds());
  const Cutout in_fixed(fixed, Pose{}, in_moving.bounds(pose));
  if (in_moving.indices.empty() || in_fixed.indices.empty()) return {};
  std::vector<TrianglePair> pairs = testing::bruteForcePairs(in_fixed.mesh(), in_moving.mesh(), pose);
  for (TrianglePair& pair : pairs) pair = {in_fixed.indices[pair.a], in_moving.indices[pair.b]};
  return pairs;
}

TEST_F(CheckCommand, saysWhatBruteForceSaysInEveryFormat) {
  constexpr int kPoses = 300;
  constexpr double kMinHits = 0.3, kMaxHits = 0.7;
  writePoses(folder_.path() / "poses.csv", posesRoundBlades(kPoses));
  const std::vector<Pose> poses = readPoses(folder_.path() / "poses.csv");
  makeMeshes(".stl");
  const TriangleMesh blisk = mesh("blisk.stl"), belt = mesh("belt.stl");

  std::vector<std::vector<TrianglePair>> truth;
  for (const Pose& pose : poses) truth.push_back(pairsThatMeet(blisk, belt, pose));
  const auto hits = kPoses - std::ranges::count(truth, true, &std::vector<TrianglePair>::empty);
  EXPECT_GE(hits, kMinHits * kPoses);
  EXPECT_LE(hits, kMaxHits * kPoses);

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

TEST_F(CheckCommand, bruteForceOfTheTestItselfLooksAtEveryTriangle) {
  makeMeshes(".stl");
  const TriangleMesh blisk = mesh("blisk.stl"), belt = mesh("belt.stl");
  for (const Pose& pose : posesRoundBlades(3)) {
    EXPECT_EQ(pairsThatMeet(blisk, belt, pose), testing::bruteForcePairs(blisk, belt, pose));
  }
}

TEST_F(CheckCommand, leavesZeroForACleanPath) {
  constexpr int kPoses = 90;
  constexpr double kClearRadius = 300.0;  // mm; the tips are at 240
  std::vector<Pose> poses;
  for (int i = 0; i < kPoses; ++i)
    poses.push_back(beltPose(2.0 * std::numbers::pi * i / kPoses, kClearRadius, 0.0));
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

}  // namespace
}  // namespace octoblisk::demos
