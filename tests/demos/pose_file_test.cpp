#include "toolpath/pose_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "demos/scratch_folder.h"

namespace octoblisk::demos {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kHeader = "x,y,z,qw,qx,qy,qz\n";
const std::string kGoodLine = "1,2,3,1,0,0,0\n";

class PoseFile : public ::testing::Test {
 protected:
  std::vector<Pose> read(const std::string& content) {
    return readPoses(folder_.write("poses.csv", content));
  }

  std::string refusal(const std::string& content) {
    const auto file = folder_.write("poses.csv", content);
    const std::string message = messageOf<std::runtime_error>([&] { readPoses(file); });
    EXPECT_THAT(message, HasSubstr(file.string())) << "names the file";
    return message;
  }

  ScratchFolder folder_;
};

TEST_F(PoseFile, isTranslationThenQuaternionWithTheScalarFirst) {
  const std::vector<Pose> poses =
      read(kHeader + "1,2,3,0.7071067811865476,0,0,0.7071067811865476\n" + kGoodLine);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].translation, Vec3(1, 2, 3));
  EXPECT_TRUE((poses[0].rotation * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-15)) << "a quarter turn about z";
  EXPECT_EQ(poses[1].rotation, Mat3::Identity());
}

TEST_F(PoseFile, namesASemicolonThatSeparatesColumns) {
  EXPECT_THAT(refusal("x;y;z;qw;qx;qy;qz\n1;2;3;1;0;0;0\n"),
              HasSubstr(":1: the columns are separated by ';'; separate them by ','"));
}

TEST_F(PoseFile, normalisesQuaternionsOfFewDigits) {
  const Mat3 rotation = read(kHeader + "0,0,0,0.7071,0.4082,-0.4082,0.4082\n").front().rotation;
  EXPECT_LE((rotation.transpose() * rotation - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_GT(rotation.determinant(), 0.0);
}

TEST_F(PoseFile, messagesShowNoRawBytes) {
  const auto isPlain = [](const std::string& text) {
    return std::ranges::all_of(text, [](char letter) { return letter >= ' ' && letter <= '~'; });
  };
  const std::string binary("\x1b[31m\x01\xff,\x80", 9);
  for (const std::string& content : {binary, kHeader + binary, kHeader + "1,2,3,1,0,0," + binary,
                                     kHeader + std::string(3, '\0'), std::string(1000, 'x')}) {
    const std::string message = refusal(content);
    EXPECT_TRUE(isPlain(message)) << message;
    EXPECT_LT(message.size(), folder_.path().string().size() + 160);
  }
  EXPECT_THAT(refusal(std::string(3, '\0')), HasSubstr("binary"));
}

TEST_F(PoseFile, comesBackAsWritten) {
  constexpr int kRandomPoses = 10'000;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<Pose> written = {{}};
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0).normalized()}) {
    for (const double angle : {0.5 * std::numbers::pi, std::numbers::pi, 1e-9}) {
      written.push_back({Eigen::AngleAxisd(angle, axis).toRotationMatrix(), 1e12 * axis});
    }
  }
  for (int i = 0; i < kRandomPoses; ++i) {
    const Eigen::Quaterniond q{normal(random), normal(random), normal(random), normal(random)};
    written.push_back(
        {q.normalized().toRotationMatrix(), {normal(random), 1e-8 * normal(random), 1e8 / 3.0}});
  }
  const auto file = folder_.path() / "written.csv";
  writePoses(file, written);
  const std::vector<Pose> back = readPoses(file);
  ASSERT_EQ(back.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(back[i].translation, written[i].translation) << i;
    EXPECT_LE((back[i].rotation - written[i].rotation).cwiseAbs().maxCoeff(), 2e-15) << i;
  }
}

TEST_F(PoseFile, refusesQuaternionsThatAreNoRotation) {
  for (const std::string quaternion :
       {"0,0,0,0", "1.0011,0,0,0", "0.9989,0,0,0", "1,1,0,0", "1e300,1e300,0,0"}) {
    EXPECT_THAT(refusal(kHeader + kGoodLine + "0,0,0," + quaternion + "\n"),
                AllOf(HasSubstr("poses.csv:3:"), HasSubstr("norm")))
        << quaternion;
  }
  EXPECT_NO_THROW(read(kHeader + "0,0,0,1.0009,0,0,0\n0,0,0,-0.9991,0,0,0\n"));
}

TEST_F(PoseFile, refusesWhatIsNoPose) {
  EXPECT_THAT(refusal(""), HasSubstr("poses.csv:1:"));
  EXPECT_THAT(refusal(kHeader), HasSubstr("no poses"));
  EXPECT_THAT(refusal("x,y,z,qx,qy,qz,qw\n" + kGoodLine), HasSubstr("poses.csv:1:"));
  EXPECT_THAT(refusal(kHeader + kGoodLine + "1,2,3,1,0,0\n"), HasSubstr("poses.csv:3:"));
  EXPECT_THAT(refusal(kHeader + "nan,2,3,1,0,0,0\n"), HasSubstr("poses.csv:2:"));
  EXPECT_THAT(refusal(kHeader + "1,2,3,1,0,0,inf\n"), HasSubstr("poses.csv:2:"));
  EXPECT_THAT(refusal(kHeader + "1,-1.1e12,3,1,0,0,0\n"),
              AllOf(HasSubstr("poses.csv:2:"), HasSubstr("1e12")));
}

TEST_F(PoseFile, namesTheFileItCannotReadOrWrite) {
  const auto missing = folder_.path() / "no" / "poses.csv";
  EXPECT_THAT(messageOf<std::runtime_error>([&] { readPoses(missing); }), HasSubstr(missing.string()));
  EXPECT_THAT(messageOf<std::runtime_error>([&] { writePoses(missing, {}); }), HasSubstr(missing.string()));
}

TEST_F(PoseFile, readsNumbersWithAPlusSign) {
  const std::vector<Pose> poses = read("x,y,z,qw,qx,qy,qz\n+5,-1,+2e0,+1,0,0,0\n");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].translation, Vec3(5, -1, 2));
}

}  // namespace
}  // namespace octoblisk::demos
