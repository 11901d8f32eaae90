// The command's output in difficult cases: full disks, links, devices. Existing files stay.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "demos/block.h"
#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "io/mesh_file.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Output : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) const { return runOctoblisk(folder_.path(), arguments); }

  /// No file can be longer than 512 bytes, so writing fails as on a full disk.
  Outcome runWithoutRoom(const std::string& arguments) const {
    const std::string command = octobliskIn(folder_.path(), arguments);
    return outcomeOf(std::system(("trap '' XFSZ; ulimit -f 1; " + command).c_str()), folder_.path());
  }

  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

  /// The names of all files in the folder and its subfolders.
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
      if (entry.is_regular_file()) found.push_back(entry.path().lexically_relative(folder_.path()).string());
    }
    return found;
  }

  ScratchFolder folder_;
};

TEST_F(Output, aFullDiskKeepsTheOldFileAndIsReported) {
  struct Case {
    std::string arguments;
    std::vector<std::string> outputs;
  };
  std::vector<Pose> poses;
  for (int i = 0; i < 200; ++i) poses.push_back(at(0.02 * i, 0.2, 0.3));
  writePoses(file("poses.csv"), poses);
  writeMesh(file("a.obj"), block({5, 5, 5}, 2));
  ASSERT_EQ(run("grind --poses-only --no-pictures --no-report --out first").exit_code, 1);
  std::vector<Pose> path = readPoses(file("first/path.csv"));
  path.resize(12);
  writePoses(file("path.csv"), path);
  ASSERT_LE(run("check --fixed a.obj --moving a.obj --poses poses.csv --shard 1/1 --out part").exit_code, 1);
  const std::vector<Case> cases = {
      {"make blisk --triangles 10000 --out b.stl", {"b.stl"}},
      {"make blisk --triangles 10000 --out b.obj", {"b.obj"}},
      {"make blisk --triangles 10000 --out b.ply", {"b.ply"}},
      {"make arm --out arm.stl", {"arm.stl"}},
      {"make grinder --out tool", {"tool/arm.ply", "tool/tool.json"}},
      {"path --out p.csv", {"p.csv"}},
      {"path --format apt --out p.cl", {"p.cl"}},
      {"blades --out blades", {"blades/blades.csv", "blades/blades.png"}},
      {"grind --path path.csv --ground-blade 1 --out run",
       {"run/poses.csv", "run/contacts.csv", "run/summary.json", "run/path.csv", "run/report.html",
        "run/run.glb", "run/contacts.vtk", "run/path.vtk", "run/overview.png", "run/coverage.csv"}},
      {"repair --path path.csv --ground-blade 1 --out mended", {"mended/path.csv", "mended/changes.csv"}},
      {"access --rows 4 --columns 5 --tilt-step 60 --out map",
       {"map/points.csv", "map/ranges.csv", "map/map.png"}},
      {"check --fixed a.obj --moving a.obj --poses poses.csv --out table.csv", {"table.csv"}},
      {"merge part --out merged.csv", {"merged.csv"}},
      {"gallery hello-shape --out shown", {"shown/hello-shape.csv", "shown/hello-shape.png"}},
      {"paper figures --out paper", {"paper/fig7.svg", "paper/report.md", "paper/report.html"}}};
  for (const auto& [arguments, outputs] : cases) {
    for (const std::string& output : outputs) {
      std::filesystem::create_directories(file(output).parent_path());
      folder_.write(output, "of an earlier run");
    }
    const Outcome outcome = runWithoutRoom(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.error, HasSubstr(": cannot be written: File too large")) << arguments;
    EXPECT_THAT(outcome.error, ::testing::Not(HasSubstr("unfinished-"))) << arguments;
    for (const std::string& output : outputs) {
      EXPECT_EQ(contentOf(file(output)), "of an earlier run") << arguments << ": " << output;
    }
  }
  for (const std::string& name : names()) EXPECT_THAT(name, ::testing::Not(HasSubstr("unfinished-")));
}

/// Each output in turn is a link to a device without space: the message names it and the cause.
class NoRoom : public Output {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "/dev/full does not exist";
    ASSERT_EQ(run("grind --poses-only --no-pictures --no-report --out first").exit_code, 1);
    std::vector<Pose> path = readPoses(file("first/path.csv"));
    path = {path.begin() + 40, path.begin() + 46};
    writePoses(file("path.csv"), path);
  }

  void expectMessage(const std::string& arguments, const std::string& out,
                     const std::vector<std::string>& outputs) {
    for (const std::string& output : outputs) {
      std::filesystem::remove_all(file(out));
      const std::filesystem::path full = out + "/" + output;
      std::filesystem::create_directories(file(full).parent_path());
      std::filesystem::create_symlink("/dev/full", file(full));
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exit_code, 2) << arguments << ": " << output;
      EXPECT_THAT(outcome.error,
                  HasSubstr("octoblisk: " + full.string() + ": cannot be written: No space left on device\n"))
          << arguments;
      EXPECT_TRUE(std::filesystem::is_symlink(file(full)));
    }
    // These are all files that it writes.
    std::filesystem::remove_all(file(out));
    std::filesystem::create_directories(file(out));
    EXPECT_LE(run(arguments).exit_code, 1) << arguments;
    std::vector<std::string> written;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(file(out))) {
      if (entry.is_regular_file()) written.push_back(entry.path().lexically_relative(file(out)).string());
    }
    EXPECT_THAT(written, ::testing::UnorderedElementsAreArray(outputs)) << arguments;
  }

  const std::vector<std::string> report_ = {"report.html", "run.glb", "contacts.vtk", "path.vtk"};
};

TEST_F(NoRoom, forTablesAndReportOfGrind) {
  std::vector<std::string> outputs = {"poses.csv",  "contacts.csv", "coverage.csv",
                                      "forces.csv", "summary.json", "path.csv"};
  outputs.insert(outputs.end(), report_.begin(), report_.end());
  expectMessage("grind --path path.csv --ground-blade 1 --spindle --poses-only --no-pictures --out o", "o",
                outputs);
}

TEST_F(NoRoom, forPicturesOfGrind) {
  expectMessage("grind --path path.csv --ground-blade 1 --poses-only --no-report --frames 1 --out o", "o",
                {"overview.png", "closeup.png", "coverage.png", "contact_sheet.png", "frames/0000.png",
                 "poses.csv", "contacts.csv", "coverage.csv", "summary.json", "path.csv"});
}

TEST_F(NoRoom, forRepair) {
  std::vector<std::string> outputs = {"path.csv", "changes.csv", "coverage.csv", "coverage.png"};
  outputs.insert(outputs.end(), report_.begin(), report_.end());
  expectMessage("repair --path path.csv --ground-blade 1 --out o", "o", outputs);
}

TEST_F(NoRoom, forAccessAndItsParts) {
  std::vector<std::string> outputs = {"points.csv", "ranges.csv", "map.png"};
  const std::string access = "access --rows 2 --columns 3 --tilt-step 60 ";
  ASSERT_LE(run(access + "--shard 1/1 --out part").exit_code, 1);
  expectMessage("merge part --out o/points.csv", "o", outputs);
  outputs.insert(outputs.end(), report_.begin(), report_.end());
  expectMessage(access + "--out o", "o", outputs);
  expectMessage(access + "--shard 1/1 --out o/part", "o", {"part"});
}

TEST_F(NoRoom, forCheckAndItsParts) {
  writeMesh(file("a.obj"), block({5, 5, 5}, 2));
  const std::string check = "check --fixed a.obj --moving a.obj --poses path.csv ";
  ASSERT_LE(run(check + "--shard 1/1 --out part").exit_code, 1);
  expectMessage(check + "--out o/table.csv", "o", {"table.csv"});
  expectMessage(check + "--shard 1/1 --out o/part", "o", {"part"});
  expectMessage("merge part --out o/table.csv", "o", {"table.csv"});
}

TEST_F(NoRoom, forMeshesPathsBladesAndScenes) {
  for (const std::string mesh : {"blisk.stl", "blisk.obj", "blisk.ply"}) {
    expectMessage("make blisk --triangles 10000 --out o/" + mesh, "o", {mesh});
  }
  for (const std::string part : {"belt", "contact-wheel", "drive-wheel", "arm"}) {
    expectMessage("make " + part + " --out o/part.stl", "o", {"part.stl"});
  }
  expectMessage("make grinder --out o", "o",
                {"belt_contact_side.ply", "belt_back.ply", "contact_wheel.ply", "drive_wheel.ply", "arm.ply",
                 "tool.json"});
  expectMessage("path --out o/path.csv", "o", {"path.csv"});
  expectMessage("path --format apt --out o/path.cl", "o", {"path.cl"});
  expectMessage("blades --out o", "o", {"blades.csv", "blades.png"});
  expectMessage("gallery hello-shape --out o", "o", {"hello-shape.csv", "hello-shape.png"});
}

TEST_F(Output, goesThroughLinks) {
  std::filesystem::create_directories(file("elsewhere"));
  folder_.write("elsewhere/path.csv", "old");
  std::filesystem::create_symlink("elsewhere/path.csv", file("link.csv"));
  std::filesystem::create_symlink("elsewhere/new.stl", file("new.stl"));  // the target does not exist yet
  std::filesystem::create_symlink("nowhere/path.csv", file("lost.csv"));
  ASSERT_EQ(run("path --out link.csv").exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(file("link.csv")));
  EXPECT_THAT(contentOf(file("elsewhere/path.csv")), StartsWith("x,y,z,"));
  ASSERT_EQ(run("make arm --out new.stl").exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(file("new.stl")));
  EXPECT_GT(std::filesystem::file_size(file("elsewhere/new.stl")), 84u);
  const Outcome lost = run("path --out lost.csv");
  EXPECT_EQ(lost.exit_code, 2);
  EXPECT_THAT(lost.error, HasSubstr("lost.csv: cannot be written: the folder "));
  // The table of a study too.
  writePoses(file("poses.csv"), std::vector<Pose>{at(0, 0, 0)});
  writeMesh(file("a.obj"), block({5, 5, 5}, 2));
  ASSERT_EQ(run("check --fixed a.obj --moving a.obj --poses poses.csv --out link.csv").exit_code, 1);
  EXPECT_TRUE(std::filesystem::is_symlink(file("link.csv")));
  EXPECT_THAT(contentOf(file("elsewhere/path.csv")), StartsWith("pose,colliding,"));
}

TEST_F(Output, goesToDevicesDirectly) {
  ASSERT_EQ(run("path --out p.csv").exit_code, 0);
  const std::string expected = contentOf(file("p.csv"));
  for (const std::string out : {"-", "/dev/stdout"}) {
    const Outcome outcome = run("path --out " + out);  // which is a file here
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_EQ(outcome.out, expected);
    EXPECT_THAT(outcome.error, StartsWith(out + ": 793 poses, ")) << "the summary must not be in the table";
    EXPECT_EQ(run("path --out " + out + " | cat >piped.csv; true").exit_code, 0);
    EXPECT_EQ(contentOf(file("piped.csv")), expected);
  }
  EXPECT_TRUE(std::filesystem::is_symlink("/dev/stdout"));
  writePoses(file("poses.csv"), std::vector<Pose>{at(0, 0, 0)});
  writeMesh(file("a.obj"), block({5, 5, 5}, 2));
  const std::string check = "check --fixed a.obj --moving a.obj --poses poses.csv ";
  ASSERT_EQ(run(check + "--out table.csv").exit_code, 1);
  ASSERT_EQ(run(check + "--shard 1/1 --out part").exit_code, 1);
  for (const std::string out : {"-", "/dev/stdout"}) {
    for (const std::string& arguments : {check, std::string("merge part ")}) {
      const Outcome outcome = run(arguments + "--out " + out);
      EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
      EXPECT_EQ(outcome.out, contentOf(file("table.csv"))) << arguments;
      EXPECT_THAT(outcome.error, StartsWith("1 pose: 1 colliding"));
    }
  }
  if (!std::filesystem::exists("/dev/full")) return;
  const Outcome full = run("path --out /dev/full");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_EQ(full.error, "octoblisk: /dev/full: cannot be written: No space left on device\n");
}

}  // namespace
}  // namespace octoblisk::demos
