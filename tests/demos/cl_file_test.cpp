#include "toolpath/cl_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <random>

#include "demos/scratch_folder.h"
#include "models/blisk.h"
#include "toolpath/cl_motions.h"
#include "toolpath/path_file.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ClFiles : public ::testing::Test {
 protected:
  ClFile read(const std::string& content) { return readClFile(folder_.write("path.cl", content)); }
  std::string refusal(const std::string& content) {
    return messageOf<std::runtime_error>([&] { read(content); });
  }
  ScratchFolder folder_;
};

std::vector<ToolMotion> randomMotions(int count) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<ToolMotion> motions;
  for (int k = 0; k < count; ++k) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond{normal(random), normal(random), normal(random), normal(random)}.normalized();
    const double feed = k % 3 == 0 ? 0.0 : 100.0 + 1.0 / 3.0 * (k / 5);
    motions.push_back({{turn.toRotationMatrix(), {normal(random), 1e3 * normal(random), 1e-7 / 3.0}}, feed});
  }
  return motions;
}

void expectSame(const std::vector<ToolMotion>& motions, const std::vector<ToolMotion>& back) {
  ASSERT_EQ(back.size(), motions.size());
  for (std::size_t k = 0; k < motions.size(); ++k) {
    EXPECT_EQ(back[k].feed, motions[k].feed) << k;
    EXPECT_EQ(back[k].tool_in_blisk.translation, motions[k].tool_in_blisk.translation) << k;
    EXPECT_LE((back[k].tool_in_blisk.rotation - motions[k].tool_in_blisk.rotation).cwiseAbs().maxCoeff(),
              1e-15);
  }
}

TEST_F(ClFiles, posesGoToAClFileAndBackAndToATableAndBack) {
  const std::vector<ToolMotion> motions = randomMotions(300);
  const auto file = folder_.path() / "written.cl";
  writeClFile(file, motions);
  const std::vector<ToolMotion> back = toolMotionsOf(readClFile(file));
  expectSame(motions, back);
  writeClFile(folder_.path() / "again.cl", back);
  expectSame(back, toolMotionsOf(readClFile(folder_.path() / "again.cl")));
  writeMotions(folder_.path() / "table.csv", motions);
  expectSame(motions, readMotions(folder_.path() / "table.csv"));
  EXPECT_EQ(readPoses(folder_.path() / "table.csv").size(), motions.size()) << "check reads it too";
}

TEST_F(ClFiles, readsWhatRealFilesHold) {
  const ClFile file = read(
      "\xEF\xBB\xBF$$ made by a CAM system\r\n"
      "PARTNO/BLISK 7 (left), $ and all\r\n"
      "$$-> MFGNO / X\r\n"
      "MACHIN / UNCX01, 1\r\n"
      "units / mm\r\n"
      "LOADTL/1,OSETNO,1 $$ the belt\r\n"
      "\r\n"
      "CUTTER/19.0,9.5\r\n"
      "MULTAX / ON\r\n"
      "SPINDL / RPM, 3000.0, CLW\r\n"
      "COOLNT/ON\r\n"
      "FROM/0,0,100\r\n"
      "RAPID\r\n"
      "GOTO / 1.5, -2., +.25E1, $ goes on\r\n"
      "$$ with a comment between\r\n"
      "   0.6, 0, $\r\n"
      "   0.8\r\n"
      "Fedrat/ 250. , mmpm\r\n"
      "go to/2,3,4\r\n"
      "PPRINT ANYTHING = (AT) ALL\r\n"
      "GODLTA/1,1,-1\r\n"
      "FEDRAT/0.1,MMPR\r\n"
      "GOTO/0,0,0,0,0,1.0004\r\n"
      "COOLNT/OFF\r\nCYCLE/OFF\r\nQUIRK/17\r\nQUIRK/18\r\nSPINDL/OFF\r\nEND\r\nFINI\r\n\r\n$$ the end\r\n");
  ASSERT_EQ(file.motions.size(), 5u);
  const auto& m = file.motions;
  EXPECT_EQ(m[0].position, Vec3(0, 0, 100));
  EXPECT_EQ(m[0].tool_axis, Vec3(0, 0, 1));
  EXPECT_EQ(m[1].position, Vec3(1.5, -2.0, 2.5));
  EXPECT_TRUE(m[1].tool_axis.isApprox(Vec3(0.6, 0, 0.8), 1e-15));
  EXPECT_EQ(m[1].feed, 0.0);
  EXPECT_EQ(m[1].line, 14u);
  EXPECT_EQ(m[2].feed, 250.0);
  EXPECT_TRUE(m[2].tool_axis.isApprox(Vec3(0.6, 0, 0.8), 1e-15)) << "the axis stays";
  EXPECT_EQ(m[3].position, Vec3(3, 4, 3));
  EXPECT_DOUBLE_EQ(m[4].feed, 300.0);
  EXPECT_EQ(m[4].tool_axis, Vec3(0, 0, 1)) << "of length 1";
  ASSERT_EQ(file.unknown.size(), 1u);
  EXPECT_EQ(file.unknown[0].word, "QUIRK");
  EXPECT_EQ(file.unknown[0].line, 26u);
}

TEST_F(ClFiles, reportsASecondTool) {
  const auto secondTool = [&](const std::string& second) {
    return read("LOADTL/1\nGOTO/0,0,0\n" + second + "\nGOTO/1,0,0\nLOADTL/1\nGOTO/2,0,0\n").second_tool;
  };
  EXPECT_EQ(secondTool("LOADTL/1"), 0u);
  EXPECT_EQ(secondTool("LOAD/TOOL,1"), 0u);
  EXPECT_EQ(secondTool("LOADTL/1,OSETNO,2"), 0u);
  EXPECT_EQ(secondTool("LOADTL"), 0u);
  EXPECT_EQ(secondTool("LOADTL/2"), 3u);
  EXPECT_EQ(secondTool("LOAD/TOOL,2"), 3u);
}

TEST_F(ClFiles, turnsInchesToMillimetres) {
  const ClFile file = read(
      "UNITS/INCHES\nFEDRAT/10,PERMIN\nGOTO/1,2,-0.5\nFEDRAT/20,MMPM\nGOTO/0,0,0\nUNITS/MM\n"
      "FEDRAT/2,IPM\nGOTO/1,2,3\nFEDRAT/30,PERMIN\nGODLTA/1,0,0\n");
  EXPECT_TRUE(file.motions[0].position.isApprox(Vec3(25.4, 50.8, -12.7), 1e-15));
  EXPECT_DOUBLE_EQ(file.motions[0].feed, 254.0);
  EXPECT_DOUBLE_EQ(file.motions[1].feed, 20.0);
  EXPECT_DOUBLE_EQ(file.motions[2].feed, 50.8);
  EXPECT_EQ(file.motions[2].position, Vec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(file.motions[3].feed, 30.0);
}

TEST_F(ClFiles, rapidIsForOneMotion) {
  const ClFile file =
      read("FEDRAT/100\nGOTO/0,0,0\nRAPID\nGOTO/1,0,0\nGOTO/2,0,0\nRAPID\nFEDRAT/50\nGOTO/3,0,0\n");
  EXPECT_EQ(file.motions[0].feed, 100.0);
  EXPECT_EQ(file.motions[1].feed, 0.0);
  EXPECT_EQ(file.motions[2].feed, 100.0);
  EXPECT_EQ(file.motions[3].feed, 50.0);
}

TEST_F(ClFiles, refusesWhatItCannotFollowAndSaysWhere) {
  const std::string good = "GOTO/0,0,0\n";
  const std::pair<const char*, const char*> cases[] = {
      {"CIRCLE/0,0,0,0,0,1,5", "CIRCLE belongs to an arc"},
      {"INDIRV/1,0,0\n", "arc"},
      {"TLON,GOFWD/ (CIRCLE/ 1,2,3,$\n5),ON,(LINE/1,2,3,4,5,6)", "arc"},
      {"MOVARC/0,0,0,0,0,1,5,ANGLE,90", "arc"},
      {"CYCLE/DRILL,5", "CYCLE makes motions"},
      {"GOFWD/C1,PAST,L2", "GOFWD makes motions"},
      {"CALL/SUB", "CALL makes motions"},
      {"TRACUT/MAT1", "TRACUT transforms the"},
      {"ORIGIN/0,0,5", "ORIGIN transforms the"},
      {"COPY/1,TRANSL,0,0,5,4", "COPY transforms the"},
      {"MSYS/0,0,5,1,0,0,0,1,0", "MSYS"},
      {"MODE/INCR", "incremental"},
      {"P1 = POINT/1,2,3", "APT source"},
      {"10) GOTO/1,2,3", "APT source"},
      {"GOTO/P1", "1 values"},
      {"GOTO/1,2,Z", "'Z' is not a finite number"},
      {"GOTO/1,2,nan", "'NAN' is not a finite number"},
      {"GOTO/1,2,inf", "'INF' is not a finite number"},
      {"GOTO/1,2,1e999", "is not a finite number"},
      {"GOTO/1,2,+-3", "is not a finite number"},
      {"GOTO/1,2,", "'' is not a finite number"},
      {"GOTO/1,2", "2 values"},
      {"GOTO", "0 values"},
      {"GOTO/1,2,3,4", "4 values"},
      {"GOTO/1,2,3,0,0,1,1,0,0,5", "10 values"},
      {"GOTO/1,2,3,0,0,0", "length is 0.0"},
      {"GOTO/1,2,3,0,0,1.01", "within 0.001"},
      {"GOTO/1,2,3,1e300,1e300,0", "length"},
      {"GOTO/1,2,3,0,0,1,0,0,1", "must be perpendicular"},
      {"GOTO/2e12,0,0", "at most 1e12"},
      {"GODLTA/5", "1 values"},
      {"TLAXIS/0,0", "TLAXIS"},
      {"UNITS/FURLONGS", "UNITS"},
      {"UNITS", "UNITS"},
      {"MULTAX/MAYBE", "MULTAX"},
      {"FEDRAT/MMPM", "needs a number"},
      {"FEDRAT/1,2", "FEDRAT"},
      {"FEDRAT/1,INVERS", "'INVERS'"},
      {"FEDRAT/-1", "above 0"},
      {"FEDRAT/0", "above 0"},
      {"FEDRAT/0.1,IPR", "SPINDL"},
      {"SPINDL/100,SFM\nFEDRAT/0.1,IPR", "SPINDL"},
      {"/1,2,3", "not an APT statement"},
      {"%O1234", "not an APT statement"},
      {"GOTO/1,2,3,$", "beyond the end"},
      {"FINI\nGOTO/1,2,3", "after FINI"}};
  for (const auto& [statement, named] : cases) {
    const std::string message = refusal(good + statement);
    EXPECT_THAT(message, AllOf(HasSubstr("path.cl:"), HasSubstr(named))) << statement;
    EXPECT_TRUE(message.find("path.cl:2:") != std::string::npos ||
                message.find("path.cl:3:") != std::string::npos)
        << message;
  }
  EXPECT_THAT(refusal(""), HasSubstr("no motions"));
  EXPECT_THAT(refusal("PARTNO X\nFINI\n"), HasSubstr("no motions"));
  EXPECT_THAT(refusal("GODLTA/1,2,3\n"), HasSubstr("path.cl:1:"));
  EXPECT_THAT(refusal(good + std::string("GOTO/1,2,3\0,4\n", 15)),
              AllOf(HasSubstr(":2:"), HasSubstr("binary")));
  EXPECT_THAT(refusal(std::string(1'000'000, 'A')), HasSubstr("no motions"));
  EXPECT_THAT(refusal(good + "GOTO/\x1b[31m,2,3"), ::testing::Not(HasSubstr("\x1b")));
  messageOf<std::runtime_error>([&] { readClFile(folder_.path() / "missing.cl"); });
  messageOf<std::runtime_error>([&] { readClFile(folder_.path()); });
}

TEST_F(ClFiles, randomBytesAreReadOrRefusedInOneLine) {
  std::mt19937 random(5);
  const std::string letters = "GOTODLTAFEDRAT/,.$$123456789-+\n\n $=()MPUNITS\x80";
  int refused = 0;
  for (int round = 0; round < 2'000; ++round) {
    std::string text = round % 2 == 0 ? "GOTO/1,2,3\n" : "";
    const int length = std::uniform_int_distribution<int>(0, 40)(random);
    for (int k = 0; k < length; ++k) text += letters[random() % letters.size()];
    try {
      read(text);
    } catch (const std::runtime_error& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_LT(refused, 2'000);
}

TEST_F(ClFiles, knowsEitherKindOfFileByExtensionOrContent) {
  const std::string table = "# poses\n\nx,y,z,qw,qx,qy,qz\n0,0,0,1,0,0,0\n";
  EXPECT_FALSE(isClFile(folder_.write("a.csv", table)));
  EXPECT_FALSE(isClFile(folder_.write("a.txt", table)));
  EXPECT_TRUE(isClFile(folder_.write("b.txt", "\n$$ x,\nGOTO/1,2,3\n")));
  EXPECT_TRUE(isClFile(folder_.write("b.CLS", table)));
  EXPECT_FALSE(isClFile(folder_.write("empty", "")));
}

TEST_F(ClFiles, programsOfMachinesAreNamed) {
  const auto tree =
      ClusteredOctree::build(std::make_shared<const TriangleMesh>(makeDefaultBlisk(10'000).mesh));
  const std::pair<const char*, const char*> programs[] = {
      {"G-code", "%\nO1000 (BLADE)\nN10 G21 G90\nN20 G0 X1.5 Y-2 Z30\nN30 G1 Z.5 F200\nX3 Y4\nM30\n%\n"},
      {"G-code", "; made by a slicer\nG28\nG1 X1 Y2 E0.3\nG1 X2 Y2 E0.6\n"},
      {"a Heidenhain program", "0 BEGIN PGM BLADE MM\n1 L X+1 Y+2 Z+3 R0 FMAX\n2 END PGM BLADE MM\n"},
      {"a KUKA KRL program", "&ACCESS RVP\nDEF blade( )\nLIN {X 1,Y 2,Z 3,A 0,B 90,C 0}\nEND\n"},
      {"an ABB RAPID program", "MODULE Blade\n  PROC main()\n    MoveL p10, v100, fine, tool1;\n  ENDPROC\n"},
      {"a FANUC TP program", "/PROG  BLADE\n/MN\n   1:L P[1] 100mm/sec FINE ;\n/END\n"}};
  for (const auto& [language, text] : programs) {
    const auto read = [&] { readPathFile(folder_.write("program.txt", text), tree); };
    EXPECT_THAT(messageOf<std::runtime_error>(read),
                AllOf(HasSubstr("program.txt: seems to be "), HasSubstr(language)));
  }
}

TEST_F(ClFiles, sixNumbersAreCompletedByTheSurface) {
  const Blisk blisk = makeDefaultBlisk(10'000);
  const auto tree = ClusteredOctree::build(std::make_shared<const TriangleMesh>(blisk.mesh));
  // Over the hub's cylinder the wheel must lie along its axis or around it, perpendicular to the arm.
  const ClFile file = read(
      "GOTO/300,0,90,1,0,0\nGOTO/138,0,90,0,1,0\nGOTO/138,0,91,0,0.6,0.8\nGOTO/138,0,92,0.9998,0.02,0\n");
  const std::vector<ToolMotion> motions = toolMotionsOf(file, tree);
  ASSERT_EQ(motions.size(), 4u);
  for (const ToolMotion& motion : motions) {
    EXPECT_TRUE(
        (motion.tool_in_blisk.rotation.transpose() * motion.tool_in_blisk.rotation).isIdentity(1e-12));
    EXPECT_NEAR(motion.tool_in_blisk.rotation.determinant(), 1.0, 1e-12);
  }
  EXPECT_TRUE(motions[1].tool_in_blisk.rotation.col(2).cwiseAbs().isApprox(Vec3(0, 0, 1), 1e-2));
  EXPECT_NEAR(motions[2].tool_in_blisk.rotation.col(2).x(), 0.0, 0.05) << "along the surface";
  EXPECT_THAT(messageOf<std::invalid_argument>([&] { toolMotionsOf(file); }), HasSubstr("line 1"));
}

TEST_F(ClFiles, aSecondAxisHoldsHoweverFarFromTheBlisk) {
  const auto tree =
      ClusteredOctree::build(std::make_shared<const TriangleMesh>(makeDefaultBlisk(10'000).mesh));
  const ClFile file =
      read("GOTO/300,0,90,1,0,0,0,0.6,0.8\nGOTO/5000,0,90,1,0,0,0,0.8,0.6\nGOTO/9000,0,90,1,0,0\n");
  const std::vector<ToolMotion> motions = toolMotionsOf(file, tree);
  ASSERT_EQ(motions.size(), 3u);
  EXPECT_TRUE(motions[0].tool_in_blisk.rotation.col(2).isApprox(Vec3(0, 0.6, 0.8), 1e-12));
  EXPECT_TRUE(motions[1].tool_in_blisk.rotation.col(2).isApprox(Vec3(0, 0.8, 0.6), 1e-12));
  for (const ToolMotion& motion : motions) {
    EXPECT_TRUE(
        (motion.tool_in_blisk.rotation.transpose() * motion.tool_in_blisk.rotation).isIdentity(1e-12));
  }
}

TEST_F(ClFiles, anArmAlongTheLastSecondAxisStillMakesARotation) {
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 100; ++round) {
    const Vec3 up = Vec3{normal(random), normal(random), normal(random)}.normalized();
    const Vec3 side = up.unitOrthogonal(), other = up.cross(side);
    const auto tree = ClusteredOctree::build(std::make_shared<const TriangleMesh>(
        std::vector<Vec3>{9.0 * side, 9.0 * other, -9.0 * (side + other)},
        std::vector<TriangleMesh::Indices>{{0, 1, 2}}));
    const ClFile file{{{0.1 * up, side, up, 0.0, 1}, {0.2 * up, up, std::nullopt, 0.0, 2}}, {}};
    for (const ToolMotion& motion : toolMotionsOf(file, tree)) {
      EXPECT_TRUE(
          (motion.tool_in_blisk.rotation.transpose() * motion.tool_in_blisk.rotation).isIdentity(1e-12));
    }
  }
}

}  // namespace
}  // namespace octoblisk::demos
