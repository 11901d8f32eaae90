// octoblisk check in parts and with interruptions, and octoblisk merge.
#include "demos/check_parts.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "access/access_table.h"
#include "study/part_text.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(CheckParts, shardsMergeToTheFileAndTheWordsOfThePlainRun) {
  for (const std::string& columns : {std::string(), all_columns_}) {
    const Outcome plain = run(check_ + columns + "--out plain.csv");
    ASSERT_EQ(plain.exit_code, 1) << plain.error;
    for (const int count : {1, 2, 3, 7}) {
      std::string parts;
      for (int i = count; i >= 1; --i) {  // the order must not matter
        const std::string name = "part" + std::to_string(i);
        const Outcome part = run(check_ + columns + "--threads " + std::to_string(i) + " --shard " +
                                 std::to_string(i) + "/" + std::to_string(count) + " --out " + name);
        ASSERT_LE(part.exit_code, 1) << part.error;
        parts += name + ' ';
      }
      const Outcome merged = run("merge " + parts + "--out merged.csv");
      EXPECT_EQ(merged.exit_code, 1) << merged.error;
      EXPECT_EQ(content("merged.csv"), content("plain.csv")) << count << " shards";
      EXPECT_EQ(withoutTimes(merged.out), withoutTimes(plain.out));
    }
  }
  const std::string summary = run(check_ + "--out plain.csv").out;
  const int colliding = std::stoi(summary.substr(summary.find(": ") + 2));
  EXPECT_GT(colliding, 0.3 * kPoses);
  EXPECT_LT(colliding, 0.7 * kPoses);
}

TEST_F(CheckParts, partsOfOtherMeshesPosesOrOptionsAreRefusedByName) {
  const auto part = [&](const std::string& options, const std::string& name) {
    const Outcome outcome = run(options + " --out " + name);
    ASSERT_LE(outcome.exit_code, 1) << outcome.error;
  };
  part(check_ + "--shard 1/2", "first");
  part(check_ + "--clearance --shard 2/2", "columns");
  part(check_ + "--shard 2/2 --threads 2 --tolerance 0.01", "second");
  part("check --fixed box.obj --moving box.obj --poses poses.csv --shard 2/2", "fixed");
  part("check --fixed ring.obj --moving ring.obj --poses poses.csv --shard 2/2", "moving");
  std::string poses = content("poses.csv");
  const std::size_t last = poses.rfind('\n', poses.size() - 2) + 1;
  folder_.write("poses.csv", poses.substr(0, last) + "9" + poses.substr(last));
  part(check_ + "--shard 2/2", "poses");
  for (const auto& [name, what] :
       {std::pair("columns", "options"), {"fixed", "fixed"}, {"moving", "moving"}, {"poses", "poses"}}) {
    const Outcome outcome = run(std::string("merge first ") + name + " --out merged.csv");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.error, std::string("octoblisk: ") + name +
                                 ": belongs to another study than first: it has other " + what + "\n");
    EXPECT_FALSE(exists("merged.csv"));
  }
  EXPECT_LE(run("merge second first --out merged.csv").exit_code, 1)
      << "threads and an unused tolerance must not matter";
}

TEST_F(CheckParts, badPartsAndTargetsAreRefusedByName) {
  for (const std::string wrong : {"0/2", "3/2", "2", "a/b", "1/2/3"}) {
    const Outcome outcome = run(check_ + "--out out.csv --shard " + wrong);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.error, StartsWith("octoblisk: --shard: '" + wrong + "' is not a part I/N"));
  }
  for (const std::string options : {"", "--shard 1/2 ", "--resume "}) {
    expectRefused(check_.substr(6) + options + "--out missing/out.csv",
                  "missing/out.csv: cannot be written: the folder missing does not exist: create it\n");
    expectRefused(check_.substr(6) + options + "--out .", ".: is a folder");
    expectRefused(check_.substr(6) + options + "--out ./poses.csv", "./poses.csv: is also");
  }
  expectRefused(check_.substr(6) + "--resume --out /dev/null",
                "/dev/null: is a device, which --resume cannot continue");
  EXPECT_EQ(run("merge poses.csv --out merged.csv").error,
            "octoblisk: poses.csv: is not a part of a study: its first line does not match\n");
  EXPECT_EQ(run("merge missing --out merged.csv").error, "octoblisk: missing: no such file\n");
  EXPECT_EQ(run("merge --out merged.csv").exit_code, 2);
  EXPECT_FALSE(exists("merged.csv"));
  EXPECT_FALSE(exists("out.csv"));
  EXPECT_FALSE(exists("out.csv.partial"));
}

/// A part of one item with right checksums.
std::string partOf(const Study& study, const std::string& rows, const std::string& tally) {
  const std::string head = headOf(study, {0, 1});
  return head + textOf({{0, 1}, rows, tally}, head);
}

/// Right checksums do not prove that octoblisk wrote the part.
TEST_F(CheckParts, partsOfRightChecksumsAndWrongWordsAreRefused) {
  const std::string columns = "pose,colliding,triangle_fixed,triangle_moving", rows = "0,0,,\n";
  const std::string right = "1 0 0 0 0 0";
  const Study study{"check", columns, 1, 64, {{"fixed", 1}}, "none"};
  const auto merge = [&](const Study& of, const std::string& tally) {
    folder_.write("part", partOf(of, rows, tally));
    return run("merge part --out merged.csv");
  };
  EXPECT_EQ(merge(study, right).exit_code, 0);
  EXPECT_EQ(content("merged.csv"), columns + '\n' + rows);
  folder_.write("merged.csv", "of an earlier run");
  EXPECT_EQ(merge(study, "1 0 0 0 0 least\x1b").error,
            "octoblisk: part: has a tally that is not from check: '1 0 0 0 0 least?'\n");
  Study other = study;
  for (const std::string options :
       {"", "non\x1b", "none depth", "clearance tolerance 0.5", "depth tolerance 1 "}) {
    other.options = options;
    std::string shown = options;
    std::ranges::replace(shown, '\x1b', '?');
    EXPECT_EQ(merge(other, right).error,
              "octoblisk: part: has options that are not from check: '" + shown + "'\n");
  }
  other = study;
  for (const std::string name : {"", "fix\ned", "\x1b[2J"}) {
    other.inputs[0].name = name;
    EXPECT_EQ(merge(other, right).error,
              "octoblisk: part: is not a part of a study: its head is damaged or truncated\n");
  }
  EXPECT_EQ(content("merged.csv"), "of an earlier run");
}

/// The other files of access are made from the finished table.
TEST_F(CheckParts, accessPartsOfRightChecksumsAndWrongWordsAreRefused) {
  const std::string row = "0,,1,2,3,0,0,1,5,7,0.5,0,-10,20,0,0,,,0.5,0.5,0 -10 20";
  const std::string right = "1 180 1\t1 belt on blade 2";
  const Study study{"access", accessColumns(), 1, 8, {{"blisk", 1}}, lineOf(AccessQuestion{})};
  const auto merge = [&](const Study& of, const std::string& rows, const std::string& tally) {
    folder_.write("part", partOf(of, rows, tally));
    return run("merge part --out points.csv");
  };
  const auto expect_refused = [&](const Study& of, const std::string& rows, const std::string& tally,
                                  const std::string& message) {
    const Outcome outcome = merge(of, rows, tally);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.error, "octoblisk: part: has " + message + '\n');
    EXPECT_FALSE(exists("ranges.csv"));
    EXPECT_EQ(content("points.csv"), "of an earlier run");
  };
  folder_.write("points.csv", "of an earlier run");
  const std::string no_map = "not from an accessibility map: ";
  Study other = study;
  other.options = "none";
  expect_refused(other, row + '\n', right, "options that are " + no_map + "'none'");
  other = study;
  other.columns = "a,b\x1b";
  expect_refused(other, row + '\n', right, "columns that are " + no_map + "'a,b?'");
  expect_refused(study, row + '\n', "1 180 1 x", "a tally that is " + no_map + "'1 180 1 x'");
  expect_refused(study, row + '\n', "1 0 1\t1 \x1b[2J", "a tally that is " + no_map + "'1 0 1?1 ?[2J'");
  expect_refused(study, "0,x\n", right, "a row that is " + no_map + "'0,x'");
  std::string word = row;
  word.replace(word.find(",5,"), 3, ",x,");
  expect_refused(study, word + '\n', right, "a row that is " + no_map + "'" + word + "'");
  expect_refused(study, row, right, "an incomplete row: '" + row + "'");
  expect_refused(study, row + '\n' + row + '\n', right, "2 rows for 1 points");
  expect_refused(study, "", right, "0 rows for 1 points");

  EXPECT_EQ(merge(study, row + '\n', right).exit_code, 1);
  EXPECT_EQ(content("points.csv"), accessColumns() + '\n' + row + '\n');
  EXPECT_THAT(content("ranges.csv"), HasSubstr("\n0,0,-10,20\n"));
}

TEST_F(CheckParts, aRunCutAnywhereIsResumedToTheSameFile) {
  ASSERT_EQ(run(check_ + all_columns_ + "--out plain.csv").exit_code, 1);
  ASSERT_EQ(run(check_ + all_columns_ + "--shard 1/1 --out whole").exit_code, 1);
  const std::string whole = content("whole");
  const Outcome plain = run(check_ + all_columns_ + "--out plain.csv");
  for (int i = 0; i <= 12; ++i) {
    folder_.write("resumed.csv.partial", whole.substr(0, whole.size() * i / 12));
    const Outcome resumed = run(check_ + all_columns_ + "--resume --out resumed.csv");
    EXPECT_EQ(resumed.exit_code, 1) << resumed.error;
    EXPECT_EQ(content("resumed.csv"), content("plain.csv")) << i;
    EXPECT_EQ(withoutTimes(resumed.out), withoutTimes(plain.out)) << i;
    EXPECT_FALSE(exists("resumed.csv.partial"));
  }
}

TEST_F(CheckParts, ctrlCLeavesWhatWasAnsweredToBeResumed) {
  repeatPoses(8);
  const std::string arguments = check_ + "--depth --clearance --threads 1 --out ";
  ASSERT_EQ(run(arguments + "plain.csv").exit_code, 1);

  const pid_t child = startOctoblisk(folder_.path(), arguments + "stopped.csv");
  EXPECT_TRUE(waitForAnswers("stopped.csv"));
  ::kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_THAT(content("stderr.txt"), StartsWith("octoblisk: stopped: stopped.csv.partial has "));
  EXPECT_THAT(content("stderr.txt"), HasSubstr(" of 4000 answers; continue with --resume\n"));
  EXPECT_FALSE(exists("stopped.csv"));
  const Outcome refused = run(arguments + "stopped.csv");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error,
              StartsWith("octoblisk: stopped.csv.partial: has the answers of an unfinished run"));
  EXPECT_EQ(run(arguments + "stopped.csv --resume").exit_code, 1);
  EXPECT_EQ(content("stopped.csv"), content("plain.csv"));
}

TEST_F(CheckParts, resultsMayGoToAPipe) {
  ASSERT_EQ(run(check_ + "--out plain.csv").exit_code, 1);
  ASSERT_EQ(run(check_ + "--out /dev/stderr 2>&1 >/dev/null | cat >piped.csv; true").exit_code, 0);
  EXPECT_EQ(content("piped.csv"), content("plain.csv"));
}

}  // namespace
}  // namespace octoblisk::demos
