// octoblisk check on the ranks of mpirun.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "demos/check_parts.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// On one machine, for any user and any number of processors.
const std::string kMpirun = std::string(MPIRUN " --oversubscribe --bind-to none ") +
                            "--mca btl_vader_single_copy_mechanism none --mca btl self,vader " +
                            (::geteuid() == 0 ? "--allow-run-as-root " : "");

class CheckRanks : public CheckParts {
 protected:
  std::string commandOf(int ranks, const std::string& arguments) const {
    return "cd '" + folder_.path().string() + "' && " + kMpirun + "-n " + std::to_string(ranks) +
           " '" OCTOBLISK_COMMAND "' " + arguments + " >stdout.txt 2>stderr.txt </dev/null";
  }

  Outcome runRanks(int ranks, const std::string& arguments) {
    return outcomeOf(std::system(commandOf(ranks, arguments).c_str()), folder_.path());
  }
};

/// The process of a rank, a descendant of another process; 0 if not found.
pid_t processOfRank(pid_t above, int rank) {
  const std::string task = "/proc/" + std::to_string(above);
  const std::string children = contentOf(task + "/task/" + std::to_string(above) + "/children");
  std::istringstream ids(children);
  for (pid_t id = 0; ids >> id;) {
    const std::string environment = '\0' + contentOf("/proc/" + std::to_string(id) + "/environ");
    const std::string wanted = '\0' + ("OMPI_COMM_WORLD_RANK=" + std::to_string(rank)) + '\0';
    if (environment.find(wanted) != std::string::npos) return id;
    if (const pid_t found = processOfRank(id, rank)) return found;
  }
  return 0;
}

TEST_F(CheckRanks, oneTwoAndFourGiveThePlainFileAndItsWords) {
  repeatPoses(2);
  const Outcome plain = run(check_ + all_columns_ + "--out plain.csv");
  ASSERT_EQ(plain.exit_code, 1) << plain.error;
  for (const int ranks : {1, 2, 4}) {
    const Outcome outcome = runRanks(ranks, check_ + all_columns_ + "--out ranks.csv");
    EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
    EXPECT_EQ(content("ranks.csv"), content("plain.csv")) << ranks;
    EXPECT_THAT(outcome.out, StartsWith(withoutTimes(plain.out).substr(0, plain.out.find(';')))) << "once";
    EXPECT_FALSE(exists("ranks.csv.partial"));
  }
}

TEST_F(CheckRanks, shardsOfRanksMergeToThePlainFile) {
  ASSERT_EQ(run(check_ + "--out plain.csv").exit_code, 1);
  ASSERT_LE(runRanks(2, check_ + "--shard 1/2 --out first").exit_code, 1);
  ASSERT_LE(run(check_ + "--shard 2/2 --out second").exit_code, 1);
  ASSERT_EQ(run("merge first second --out merged.csv").exit_code, 1);
  EXPECT_EQ(content("merged.csv"), content("plain.csv"));
}

TEST_F(CheckRanks, accessOfOneTwoAndFourGivesThePlainFilesAndSoDoShards) {
  const std::string access = "access --rows 4 --columns 5 --tilt-step 30 ";
  const Outcome plain = run(access + "--out plain");
  ASSERT_LE(plain.exit_code, 1) << plain.error;
  const auto expectPlainIn = [&](const std::string& folder) {
    for (const char* file : {"/points.csv", "/ranges.csv", "/map.png"}) {
      EXPECT_EQ(content(folder + file), content("plain" + std::string(file))) << folder << file;
    }
  };
  for (const int ranks : {1, 2, 4}) {
    const std::string folder = "ranks" + std::to_string(ranks);
    const Outcome outcome = runRanks(ranks, access + "--out " + folder);
    EXPECT_EQ(outcome.exit_code, plain.exit_code) << outcome.error;
    expectPlainIn(folder);
  }
  ASSERT_LE(runRanks(2, access + "--shard 1/2 --out first").exit_code, 1);
  ASSERT_LE(run(access + "--shard 2/2 --out second").exit_code, 1);
  std::filesystem::create_directories(folder_.path() / "merged");
  ASSERT_EQ(run("merge first second --out merged/points.csv").exit_code, plain.exit_code);
  expectPlainIn("merged");
}

TEST_F(CheckRanks, aLostRankIsMadeGoodByResuming) {
  repeatPoses(12);
  const std::string arguments = check_ + "--depth --clearance --threads 1 --out ";
  ASSERT_EQ(run(arguments + "plain.csv").exit_code, 1);
  const std::string whole = content("plain.csv");
  for (const int lost : {1, 0}) {
    const std::string name = "lost" + std::to_string(lost) + ".csv";
    const pid_t child = ::fork();
    if (child == 0) {
      ::execl("/bin/sh", "sh", "-c", commandOf(3, arguments + name).c_str(), nullptr);
      ::_exit(127);
    }
    EXPECT_TRUE(waitForAnswers(name));
    const pid_t rank = processOfRank(child, lost);
    ASSERT_GT(rank, 0);
    ::kill(rank, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_NE(status, 0);
    ASSERT_FALSE(exists(name)) << "the rank was lost too late for this test";
    const std::string left = content(name + ".partial");
    EXPECT_THAT(left, HasSubstr("# checksum"));

    const Outcome resumed = runRanks(2, arguments + name + " --resume");
    EXPECT_EQ(resumed.exit_code, 1) << resumed.error;
    EXPECT_EQ(content(name), whole) << lost;
    EXPECT_FALSE(exists(name + ".partial"));
    folder_.write("again.csv.partial", left);
    EXPECT_EQ(run(arguments + "again.csv --resume").exit_code, 1);
    EXPECT_EQ(content("again.csv"), whole) << "resumed without mpirun";
  }
}

TEST_F(CheckRanks, badInputIsReportedOnceAndLeavesNoFile) {
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = runRanks(3, arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    const std::size_t first = outcome.error.find(message);
    ASSERT_NE(first, std::string::npos) << outcome.error;
    EXPECT_EQ(outcome.error.find(message, first + 1), std::string::npos) << outcome.error;
    EXPECT_FALSE(exists("out.csv"));
    EXPECT_FALSE(exists("out.csv.partial"));
  };
  refused("check --fixed no.obj --moving box.obj --poses poses.csv --out out.csv",
          "octoblisk: no.obj: no such");
  refused("check --fixed ring.obj --moving box.obj --poses no.csv --out out.csv",
          "octoblisk: no.csv: no such");
  refused(check_ + "--out missing/out.csv",
          "octoblisk: missing/out.csv: cannot be written: the folder missing does not exist: create it");
  refused(check_ + "--out out.csv --shard 3/2", "octoblisk: --shard: '3/2' is not a part");
}

}  // namespace
}  // namespace octoblisk::demos
