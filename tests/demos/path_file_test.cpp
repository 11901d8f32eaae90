// Toolpaths written back in their own format with some poses changed.
#include "toolpath/path_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "demos/scratch_folder.h"
#include "models/shared_tree.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

std::vector<std::string> linesOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class PathFileTest : public ::testing::Test {
 protected:
  /// Changes some poses, writes the path, reads it back and compares it with the written poses. Returns which
  /// lines of the file were kept.
  std::vector<bool> changed(const std::filesystem::path& file, const std::vector<std::size_t>& which) {
    const PathFile read = readPathFile(file, *blisk_);
    std::vector<Pose> poses = read.poses();
    for (const std::size_t i : which) {
      const Vec3 axis = octoblisk::testing::randomRotation(random_).col(0);
      const Mat3 turn = Eigen::AngleAxisd(0.2, axis).toRotationMatrix();
      poses[i] = {turn * poses[i].rotation,
                  poses[i].translation + octoblisk::testing::randomPoint(random_, 3.0)};
    }
    const std::filesystem::path target = folder_.path() / ("changed" + file.extension().string());
    writeChangedPath(read, file, *blisk_, poses, target);
    const PathFile back = readPathFile(target, *blisk_);
    EXPECT_EQ(back.motions.size(), read.motions.size());
    for (std::size_t i = 0; i < std::min(read.motions.size(), back.motions.size()); ++i) {
      EXPECT_LT((back.motions[i].tool_in_blisk.translation - poses[i].translation).norm(), 1e-9) << i;
      EXPECT_LT((back.motions[i].tool_in_blisk.rotation - poses[i].rotation).norm(), 1e-8) << i;
      EXPECT_EQ(back.motions[i].feed, read.motions[i].feed) << i;
    }
    const std::vector<std::string> written = linesOf(target);
    std::vector<bool> kept;
    auto from = written.begin();
    for (const std::string& line : linesOf(file)) {
      const auto found = std::find(from, written.end(), line);
      kept.push_back(found != written.end());
      if (kept.back()) from = found + 1;
    }
    return kept;
  }

  ScratchFolder folder_;
  std::mt19937_64 random_{120};
  std::shared_ptr<const ClusteredOctree> blisk_ = treeOf(octoblisk::testing::torus(200, 30, 48, 24));
};

TEST_F(PathFileTest, ofATableKeepsFeedsCommentsAndUnchangedRows) {
  const auto file = folder_.write("path.csv",
                                  "# made by hand\r\nx,y,z,qw,qx,qy,qz,feed\r\n"
                                  "300,0,0,1,0,0,0,0\r\n\r\n290, 0, 0, 1, 0, 0, 0, 1500\r\n"
                                  "# the pass\r\n280,0,0,0,0,1,0,1e3\r\n270,0,0,1,0,0,0,1000.50\r\n");
  EXPECT_EQ(changed(file, {1, 3}), (std::vector<bool>{true, true, true, true, false, true, true, false}));
  EXPECT_EQ(changed(file, {}), std::vector<bool>(8, true));
  const auto plain = folder_.write("plain.csv", "x,y,z,qw,qx,qy,qz\n1,2,3,1,0,0,0\n4,5,6,1,0,0,0\n");
  EXPECT_EQ(changed(plain, {0}), (std::vector<bool>{true, false, true}));
}

TEST_F(PathFileTest, ofAClFileKeepsAllThatIsNotChanged) {
  const auto file = folder_.write("path.cls",
                                  "PARTNO BLISK 7, OP 20\n"            // 0
                                  "$$ by hand\n"                       // 1
                                  "UNITS/INCHES\n"                     // 2
                                  "LOADTL/3\n"                         // 3
                                  "SPINDL/2000,RPM,CLW\n"              // 4
                                  "FROM/12,0,1\n"                      // 5: motion 0
                                  "RAPID\n"                            // 6
                                  "GOTO/11,0,1,1,0,0\n"                // 7: motion 1
                                  "FEDRAT/0.001,IPR\n"                 // 8
                                  "COOLNT/ON\n"                        // 9
                                  "GOTO / 9.5 , 0, 0.5 $$ approach\n"  // 10: motion 2
                                  "GODLTA/-0.1,0.05,0\n"               // 11: motion 3
                                  "GODLTA/-0.1,0.05,0\n"               // 12: motion 4
                                  "UNITS/MM\n"                         // 13
                                  "FEDRAT/900\n"                       // 14
                                  "GOTO/230,4,8, $\n"                  // 15: motion 5
                                  "  0.8,0,0.6\n"                      // 16
                                  "GOTO/231,5,8\n"                     // 17: motion 6
                                  "GOTO/232,6,8,1,0,0,0,0,1\n"         // 18: motion 7
                                  "COOLNT/OFF\n"                       // 19
                                  "FINI\n");                           // 20
  EXPECT_EQ(changed(file, {}), std::vector<bool>(21, true));
  const auto keptBut = [](std::vector<std::size_t> lost) {
    std::vector<bool> kept(21, true);
    for (const std::size_t line : lost) kept[line] = false;
    return kept;
  };
  // No later motion depends on this absolute one.
  EXPECT_EQ(changed(file, {7}), keptBut({18}));
  // The next motion inherits the tool axis of the changed one.
  EXPECT_EQ(changed(file, {5}), keptBut({15, 16, 17}));
  // Two motions continue from the changed one.
  EXPECT_EQ(changed(file, {2}), keptBut({10, 11, 12}));
  EXPECT_EQ(changed(file, {0}), keptBut({5}));
  for (int i = 0; i < 40; ++i) {
    std::vector<std::size_t> some;
    for (std::size_t m = 0; m < 8; ++m) {
      if (octoblisk::testing::uniform(random_, 0.0, 1.0) < 0.3) some.push_back(m);
    }
    const std::vector<bool> kept = changed(file, some);
    for (const std::size_t line : {0, 1, 2, 3, 4, 6, 8, 9, 13, 14, 19, 20}) EXPECT_TRUE(kept[line]) << line;
  }
}

TEST_F(PathFileTest, aCommentBehindAChangedMotionStays) {
  const auto file =
      folder_.write("path.cl", "GOTO/300,0,0,1,0,0,0,0,1 $$ first\nGOTO/290,0,0,1,0,0,0,0,1\nFINI\n");
  changed(file, {0});
  const auto lines = linesOf(folder_.path() / "changed.cl");
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_TRUE(lines[2].ends_with(" $$ first")) << lines[2];
  EXPECT_EQ(lines[3], "GOTO/290,0,0,1,0,0,0,0,1");
}

}  // namespace
}  // namespace octoblisk::demos
