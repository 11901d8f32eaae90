// octoblisk access in parts and with interruptions, and octoblisk merge.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "models/embedded_assets.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class AccessParts : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), arguments); }
  std::string content(const std::string& name) const { return contentOf(folder_.path() / name); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }

  const std::string access_ =
      "access --rows 5 --columns 5 --tilt-step 30 --lead-from -10 --lead-to 10 --lead-step 10 ";
  ScratchFolder folder_;
};

TEST_F(AccessParts, shardsMergeToTheFilesAndWordsOfThePlainRun) {
  const Outcome plain = run(access_ + "--out plain");
  ASSERT_LE(plain.exit_code, 1) << plain.error;
  for (const int count : {1, 3}) {
    std::string parts;
    for (int i = count; i >= 1; --i) {
      const std::string name = "part" + std::to_string(i);
      const Outcome part = run(access_ + "--threads " + std::to_string(i) + " --shard " + std::to_string(i) +
                               "/" + std::to_string(count) + " --out " + name);
      ASSERT_LE(part.exit_code, 1) << part.error;
      EXPECT_THAT(part.out, HasSubstr("points of blade 1"));
      parts += name + ' ';
    }
    std::filesystem::create_directories(folder_.path() / "merged");
    const Outcome merged = run("merge " + parts + "--out merged/points.csv");
    EXPECT_EQ(merged.exit_code, plain.exit_code) << merged.error;
    EXPECT_EQ(merged.out.substr(0, merged.out.find("Tables:")),
              plain.out.substr(0, plain.out.find("Tables:")));
    for (const char* file : {"points.csv", "ranges.csv", "map.png"}) {
      EXPECT_EQ(content("merged/" + std::string(file)), content("plain/" + std::string(file))) << file;
    }
  }
  EXPECT_GT(content("plain/ranges.csv").size(), 200u);
}

TEST_F(AccessParts, partsOfOtherQuestionsAreRefusedByName) {
  ASSERT_LE(run(access_ + "--shard 1/2 --out first").exit_code, 1);
  ASSERT_LE(run(access_ + "--margin 0.1 --shard 2/2 --out margin").exit_code, 1);
  ASSERT_LE(run(access_ + "--ground-blade 2 --shard 2/2 --out blade").exit_code, 1);
  for (const char* other : {"margin", "blade"}) {
    const Outcome outcome = run("merge first " + std::string(other) + " --out points.csv");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.error, HasSubstr(std::string(other) + ": belongs to another study than first"));
    EXPECT_FALSE(exists("points.csv"));
  }
  EXPECT_EQ(run(access_ + "--shard 3/2 --out part").exit_code, 2);
}

TEST_F(AccessParts, anUnfinishedRunIsGoneOnFrom) {
  ASSERT_LE(run(access_ + "--out plain --no-picture").exit_code, 1);
  // A run that ended after its first group leaves a truncated part.
  ASSERT_LE(run(access_ + "--shard 1/1 --out whole").exit_code, 1);
  const std::string whole = content("whole");
  const std::size_t first = whole.find("# checksum"), second = whole.find("# checksum", first + 1);
  ASSERT_NE(second, std::string::npos);
  std::filesystem::create_directories(folder_.path() / "again");
  folder_.write("again/points.csv.partial", whole.substr(0, second + 30));
  const Outcome refused = run(access_ + "--out again --no-picture");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error, HasSubstr("has the answers of an unfinished run"));
  const Outcome resumed = run(access_ + "--resume --out again --no-picture");
  EXPECT_LE(resumed.exit_code, 1) << resumed.error;
  for (const char* file : {"points.csv", "ranges.csv"}) {
    EXPECT_EQ(content("again/" + std::string(file)), content("plain/" + std::string(file))) << file;
  }
  EXPECT_FALSE(exists("again/points.csv.partial"));
}

}  // namespace
}  // namespace octoblisk::demos
