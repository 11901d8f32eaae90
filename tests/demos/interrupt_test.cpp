// Ctrl-C during grind and repair: the finished poses are kept, marked as partial.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>

#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Whether the process is octoblisk and has its own handler for SIGINT. The shell that starts it has one too.
bool handlesInterrupt(pid_t process) {
  std::istringstream status(contentOf("/proc/" + std::to_string(process) + "/status"));
  for (std::string key, name; status >> key;) {
    std::uint64_t signals = 0;
    if (key == "Name:" && status >> name && name != "octoblisk") return false;
    if (key == "SigCgt:" && status >> std::hex >> signals) return (signals >> (SIGINT - 1) & 1) != 0;
  }
  return false;
}

class Interrupt : public ::testing::Test {
 protected:
  /// Runs it until it reacts to Ctrl-C and has worked for a while, then sends Ctrl-C.
  Outcome interrupted(const std::string& arguments) {
    using namespace std::chrono_literals;
    const pid_t child = startOctoblisk(folder_.path(), arguments);
    for (int wait = 0; wait < 6'000 && !handlesInterrupt(child); ++wait) std::this_thread::sleep_for(10ms);
    std::this_thread::sleep_for(300ms);
    ::kill(child, SIGINT);
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    return outcomeOf(status, folder_.path());
  }
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  bool exists(const std::string& name) const { return std::filesystem::exists(file(name)); }

  /// Poses beside the disk and near it, enough for a long run.
  void writeLongPath() const {
    std::vector<Pose> path;
    for (int k = 0; k < 200'000; ++k) {
      path.push_back({Mat3::Identity(), Vec3(131.0 + 1e-3 * (k % 1000), 0.0, 0.0)});
    }
    writePoses(file("long.csv"), path);
  }

  ScratchFolder folder_;
};

TEST_F(Interrupt, grindKeepsThePosesDone) {
  writeLongPath();
  const Outcome stopped =
      interrupted("grind --path long.csv --ground-blade 1 --no-pictures --no-report --out run");
  EXPECT_EQ(stopped.exit_code, 130);
  if (!exists("run/summary.json")) {  // the machine was too busy to reach a pose
    EXPECT_THAT(stopped.error, HasSubstr("stopped before the first pose was done: no file was written"));
    return;
  }
  EXPECT_EQ(stopped.error, "octoblisk: stopped: run has the finished poses, marked as partial\n");
  const auto summary = nlohmann::json::parse(contentOf(file("run/summary.json")));
  EXPECT_EQ(summary["partial"], true);
  EXPECT_EQ(summary["poses_of_path"], 200'000);
  EXPECT_GT(summary["poses"]["total"], 0);
  EXPECT_LT(summary["poses"]["total"], 200'000);
  EXPECT_THAT(stopped.out, StartsWith("Stopped: "));
}

TEST_F(Interrupt, grindKeepsItsTablesWhileItDraws) {
  using namespace std::chrono_literals;
  const auto isDrawing = [this] {
    if (!exists("run")) return false;
    const std::filesystem::directory_iterator files(file("run"));
    return std::ranges::any_of(files, [](const auto& entry) {
      return entry.path().filename().string().find("summary") != std::string::npos;
    });
  };
  const pid_t child = startOctoblisk(folder_.path(), "grind --frames 400 --out run");
  int status = 0;
  for (int wait = 0; wait < 18'000 && !isDrawing(); ++wait) {
    ASSERT_EQ(::waitpid(child, &status, WNOHANG), 0) << "it ended before it drew";
    std::this_thread::sleep_for(10ms);
  }
  ::kill(child, SIGINT);
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  const Outcome stopped = outcomeOf(status, folder_.path());
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_EQ(stopped.error, "octoblisk: stopped: run has all tables, but not all pictures\n");
  EXPECT_EQ(nlohmann::json::parse(contentOf(file("run/summary.json")))["partial"], false);
  EXPECT_TRUE(exists("run/poses.csv"));
  EXPECT_FALSE(exists("run/frames"));
  EXPECT_FALSE(exists("run/report.html"));
}

TEST_F(Interrupt, repairLeavesWhatItHas) {
  const Outcome stopped = interrupted("repair --out run");
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_EQ(stopped.error, "octoblisk: stopped: the poses repaired so far are in run/path.csv.partial\n");
  EXPECT_THAT(stopped.out, HasSubstr("stopped before all motions were checked"));
  EXPECT_FALSE(exists("run/path.csv"));
  EXPECT_FALSE(exists("run/changes.csv"));
  EXPECT_GT(readPoses(file("run/path.csv.partial")).size(), 300u);
  EXPECT_THAT(contentOf(file("run/changes.csv.partial")), HasSubstr("\n0,"));
}

}  // namespace
}  // namespace octoblisk::demos
