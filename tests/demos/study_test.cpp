// Studies in parts and with interruptions: the table equals that of one run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <iomanip>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "demos/squares_study.h"
#include "io/number_text.h"
#include "study/merge_parts.h"
#include "study/part_text.h"
#include "study/stop_signal.h"

namespace octoblisk::demos {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::size_t kItems = 50;

class StudyFiles : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  bool exists(const std::string& name) const { return std::filesystem::exists(file(name)); }
  std::string content(const std::string& name) const { return contentOf(file(name)); }

  StudyOutcome run(const Study& study, const StudyTarget& target, const AnswerItems& answer) {
    Ranks alone;
    return runStudy(study, target, {}, alone, answer);
  }
  StudyOutcome run(const StudyTarget& target) {
    return run(squaresStudy(kItems), target, [](ItemRange items) { return squaresOf(items); });
  }

  /// Runs until at least this many items are answered, then stops.
  void runUntil(const StudyTarget& target, std::size_t items) {
    const auto break_there = [&](ItemRange asked) {
      if (asked.begin >= items) throw std::runtime_error("the machine is gone");
      return squaresOf(asked);
    };
    EXPECT_EQ(messageOf<std::runtime_error>([&] { run(squaresStudy(kItems), target, break_there); }),
              "the machine is gone");
  }

  /// Writes one part per shard and returns their names.
  std::vector<std::filesystem::path> writeParts(std::size_t count, const Study& study) {
    std::vector<std::filesystem::path> parts;
    for (std::size_t i = 1; i <= count; ++i) {
      const std::string name = file(std::to_string(i) + "_of_" + std::to_string(count));
      run(study, {name, Shard{i, count}}, [](ItemRange items) { return squaresOf(items); });
      parts.push_back(name);
    }
    return parts;
  }
  std::vector<std::filesystem::path> writeParts(std::size_t count) {
    return writeParts(count, squaresStudy(kItems));
  }

  std::string refusalOf(const std::vector<std::filesystem::path>& parts) {
    const std::string message = messageOf<std::runtime_error>([&] { mergeParts(parts, file("merged.csv")); });
    EXPECT_FALSE(exists("merged.csv"));
    const std::string folder = folder_.path().string() + '/';
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }

  ScratchFolder folder_;
};

TEST_F(StudyFiles, aStudyInOneRunIsItsTable) {
  const StudyOutcome outcome = run({file("all.csv"), {}});
  EXPECT_EQ(content("all.csv"), squaresTable(kItems));
  EXPECT_EQ(outcome.answered, kItems);
  EXPECT_EQ(outcome.tallies.size(), 13u);
  EXPECT_EQ(outcome.tallies.back(), "2 items");
  EXPECT_FALSE(exists("all.csv.partial"));
}

TEST_F(StudyFiles, shardsOfAnyNumberMergeToTheTable) {
  for (const std::size_t items : {std::size_t{1}, std::size_t{4}, kItems, std::size_t{200}}) {
    for (const std::size_t shards : {1u, 2u, 3u, 7u, 30u}) {
      std::vector<std::filesystem::path> parts = writeParts(shards, squaresStudy(items));
      std::shuffle(parts.begin(), parts.end(), std::mt19937_64(items + shards));
      const MergedStudy merged = mergeParts(parts, file("merged.csv"));
      EXPECT_EQ(content("merged.csv"), squaresTable(items)) << items << " items, " << shards << " shards";
      EXPECT_EQ(merged.tallies.size(), (items + 3) / 4);
      EXPECT_EQ(merged.study.name, "squares");
    }
  }
}

TEST_F(StudyFiles, shardsOfEachNumberHoldEachItemOnceInWholeGroups) {
  for (const std::size_t items : {1u, 63u, 64u, 65u, 2185u}) {
    Study study = squaresStudy(items);
    study.group = 64;
    for (const std::size_t count : {1u, 2u, 3u, 7u, 100u, 1000000u}) {
      std::size_t end = 0, most = 0, least = items;
      for (std::size_t i = 1; i <= std::min<std::size_t>(count, 200); ++i) {
        const ItemRange part = itemsOf(study, {i, count});
        EXPECT_EQ(part.begin, end);
        EXPECT_TRUE(part.begin % 64 == 0 || part.begin == items);
        end = part.end;
        most = std::max(most, part.size());
        least = std::min(least, part.size());
      }
      if (count <= 200) {
        EXPECT_EQ(end, items);
      }
      EXPECT_LE(most, least + 64 + 63);
      EXPECT_EQ(itemsOf(study, {count, count}).end, items);
    }
  }
}

TEST_F(StudyFiles, aShardIsReportedAsPartAndWhole) {
  EXPECT_EQ(parseShard("3/7").index, 3u);
  EXPECT_EQ(parseShard("3/7").count, 7u);
  for (const std::string wrong : {"", "3", "3/", "/7", "0/7", "8/7", "-1/7", "3/7x", "1/0", "3 / 7",
                                  "1/2000000", "99999999999999999999/99999999999999999999"}) {
    EXPECT_THAT(messageOf<std::invalid_argument>([&] { parseShard(wrong); }),
                AllOf(StartsWith("'"), HasSubstr(wrong.substr(0, 60) + "' is not a part I/N")))
        << wrong;
  }
}

TEST_F(StudyFiles, mergeRefusesWhatIsNotTheWholeStudyAndNamesTheFile) {
  const std::vector<std::filesystem::path> parts = writeParts(3);
  EXPECT_EQ(refusalOf({parts[0], parts[2]}),
            "3_of_3: begins at item 32: items 16 to 32 after those of " + parts[0].string() + " are missing");
  EXPECT_EQ(refusalOf({parts[1], parts[2]}), "2_of_3: begins at item 16: items 0 to 16 are missing");
  EXPECT_EQ(refusalOf({parts[1], parts[0]}), "2_of_3: ends before item 32, and no part has items 32 to 50");
  EXPECT_EQ(refusalOf({parts[0], parts[1], parts[1], parts[2]}),
            "2_of_3: repeats items of " + parts[1].string() + ", from 16");
  const std::vector<std::filesystem::path> halves = writeParts(2);
  EXPECT_THAT(refusalOf({parts[0], parts[1], halves[1]}), StartsWith("2_of_2: repeats items of "));
  EXPECT_EQ(refusalOf({parts[0], file("missing")}), "missing: no such file");
  EXPECT_EQ(refusalOf({parts[0], folder_.path()}),
            folder_.path().string() + ": is a folder: give the name of a file");
  EXPECT_THAT(refusalOf({folder_.write("table.csv", squaresTable(kItems))}),
              StartsWith("table.csv: is not a part of a study"));
  EXPECT_THAT(refusalOf({folder_.write("empty", "")}), StartsWith("empty: is not a part of a study"));
}

TEST_F(StudyFiles, mergeRefusesPartsOfOtherStudies) {
  const std::vector<std::filesystem::path> parts = writeParts(2);
  const auto refusalWith = [&](const Study& other) {
    run(other, {file("other"), Shard{2, 2}}, [](ItemRange items) { return squaresOf(items); });
    return refusalOf({parts[0], file("other")});
  };
  const std::string begin = "other: belongs to another study than " + parts[0].string() + ": it has other ";
  Study other = squaresStudy(kItems);
  other.inputs[1].fingerprint = 3;
  EXPECT_EQ(refusalWith(other), begin + "rules");
  other = squaresStudy(kItems);
  other.options = "some";
  EXPECT_EQ(refusalWith(other), begin + "options");
  other = squaresStudy(kItems);
  other.columns += ",more";
  EXPECT_EQ(refusalWith(other), begin + "options");
  other = squaresStudy(kItems + 1);
  EXPECT_EQ(refusalWith(other), begin + "items");
  other = squaresStudy(kItems);
  other.name = "cubes";
  EXPECT_EQ(refusalWith(other), begin + "subcommand");
  other = squaresStudy(kItems);
  other.inputs.pop_back();
  EXPECT_EQ(refusalWith(other), begin + "rules");
}

TEST_F(StudyFiles, mergeRefusesAPartCutOffOrChangedAtAnyByte) {
  const std::vector<std::filesystem::path> parts = writeParts(2);
  const std::string whole = contentOf(parts[1]);
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    folder_.write("cut", whole.substr(0, bytes));
    ASSERT_THAT(refusalOf({parts[0], file("cut")}), StartsWith("cut: is ")) << bytes;
    std::string changed = whole;
    changed[bytes] = static_cast<char>(changed[bytes] ^ 1);
    folder_.write("changed", changed);
    ASSERT_THAT(refusalOf({parts[0], file("changed")}), StartsWith("changed: ")) << bytes;
  }
  folder_.write("longer", whole + "more");
  EXPECT_EQ(refusalOf({parts[0], file("longer")}),
            "longer: has extra bytes after its end: make the part again");
}

TEST_F(StudyFiles, mergeNeverWritesOverAPart) {
  const std::vector<std::filesystem::path> parts = writeParts(2);
  const std::string before = contentOf(parts[1]);
  EXPECT_THAT(messageOf<std::runtime_error>([&] { mergeParts(parts, parts[1].string()); }),
              HasSubstr("is also an input file"));
  EXPECT_EQ(contentOf(parts[1]), before);
}

TEST_F(StudyFiles, aBrokenRunGoesOnWhereverItsFileEnds) {
  runUntil({file("all.csv"), {}}, 30);
  EXPECT_FALSE(exists("all.csv"));
  const std::string left = content("all.csv.partial");
  std::size_t fewest = kItems, most = 0;
  for (std::size_t bytes = 0; bytes <= left.size(); ++bytes) {
    folder_.write("all.csv.partial", left.substr(0, bytes));
    const StudyOutcome outcome = run({file("all.csv"), {}, true});
    ASSERT_EQ(content("all.csv"), squaresTable(kItems)) << bytes;
    ASSERT_EQ(outcome.tallies.size(), 13u) << bytes;
    ASSERT_FALSE(exists("all.csv.partial")) << bytes;
    fewest = std::min(fewest, outcome.answered);
    most = std::max(most, outcome.answered);
    std::filesystem::remove(file("all.csv"));
  }
  EXPECT_LE(fewest, 20u) << "answered items are not run again";
  EXPECT_EQ(most, kItems) << "without a part, all items are run again";
}

TEST_F(StudyFiles, aBrokenShardGoesOnAndAFinishedOneStays) {
  const std::vector<std::filesystem::path> parts = writeParts(2);
  const std::string whole = contentOf(parts[1]);
  const StudyTarget again{file("again"), Shard{2, 2}, true};
  runUntil(again, 40);
  EXPECT_LT(run(again).answered, 26u);
  EXPECT_EQ(content("again"), whole);
  EXPECT_EQ(run(again).answered, 0u);
  EXPECT_EQ(run(again).tallies.size(), 7u);
  EXPECT_EQ(content("again"), whole);
  EXPECT_FALSE(exists("again.partial"));
  EXPECT_EQ(run({file("again"), Shard{1, 2}, true}).answered, 24u)
      << "a different shard must not count as finished";
  EXPECT_EQ(content("again"), contentOf(parts[0]));
}

TEST_F(StudyFiles, answersMayComeInAnyOrder) {
  Study study = squaresStudy(kItems);
  std::vector<AnsweredGroup> groups = squaresOf({0, kItems});
  std::shuffle(groups.begin(), groups.end(), std::mt19937_64(7));
  std::string text = headOf(study, {0, kItems});
  std::size_t answered = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    text += textOf(groups[i], headOf(study, {0, kItems}));
    answered += groups[i].items.size();
  }
  folder_.write("all.csv.partial", text + "# checks");
  std::vector<ItemRange> asked;
  run(study, {file("all.csv"), {}, true}, [&](ItemRange items) {
    asked.push_back(items);
    return squaresOf(items);
  });
  EXPECT_EQ(content("all.csv"), squaresTable(kItems));
  std::size_t count = 0;
  for (const ItemRange& items : asked) count += items.size();
  EXPECT_EQ(count, kItems - answered);
  EXPECT_GT(asked.size(), 1u) << "there were gaps";
}

TEST_F(StudyFiles, anUnfinishedRunIsNeitherWrittenOverNorMistaken) {
  runUntil({file("all.csv"), {}}, 30);
  const std::string left = content("all.csv.partial");
  const auto refusal = [&](const Study& study, const StudyTarget& target) {
    const std::string message = messageOf<std::runtime_error>(
        [&] { run(study, target, [](ItemRange items) { return squaresOf(items); }); });
    EXPECT_EQ(content("all.csv.partial"), left);
    EXPECT_FALSE(exists("all.csv"));
    EXPECT_THAT(message, StartsWith(file("all.csv.partial: ")));
    return message;
  };
  EXPECT_THAT(refusal(squaresStudy(kItems), {file("all.csv"), {}}),
              HasSubstr("continue it with --resume, or remove"));
  Study other = squaresStudy(kItems);
  other.inputs[0].fingerprint = 9;
  EXPECT_THAT(refusal(other, {file("all.csv"), {}, true}), HasSubstr("belongs to a run with other numbers"));
  EXPECT_THAT(refusal(squaresStudy(kItems), {file("all.csv"), Shard{1, 2}, true}),
              HasSubstr("belongs to another part: items 0 to 50"));
  folder_.write("all.csv.partial", "something of the user's own");
  EXPECT_THAT(messageOf<std::runtime_error>([&] {
                run({file("all.csv"), {}});
              }),
              HasSubstr("is not a part of a study"));
  EXPECT_EQ(content("all.csv.partial"), "something of the user's own");
}

TEST_F(StudyFiles, ofTwoRunsToOneFileTheSecondIsRefused) {
  std::string refused;
  run(squaresStudy(kItems), {file("all.csv"), {}}, [&](ItemRange items) {
    if (refused.empty()) refused = messageOf<std::runtime_error>([&] { run({file("all.csv"), {}, true}); });
    return squaresOf(items);
  });
  EXPECT_EQ(refused, file("all.csv: another run is writing it: wait for it, or choose another --out"));
  EXPECT_EQ(content("all.csv"), squaresTable(kItems));
}

TEST_F(StudyFiles, aRunThatAnsweredNothingLeavesNothing) {
  folder_.write("all.csv", "earlier");
  runUntil({file("all.csv"), {}}, 0);
  EXPECT_EQ(content("all.csv"), "earlier");
  EXPECT_FALSE(exists("all.csv.partial"));
  EXPECT_EQ(run({file("all.csv"), {}}).answered, kItems) << "a finished table is replaced";
  EXPECT_EQ(content("all.csv"), squaresTable(kItems));
}

TEST_F(StudyFiles, aStopLeavesWhatWasAnswered) {
  const auto stop_at_once = [&](ItemRange items) {
    std::raise(SIGTERM);
    return squaresOf(items);
  };
  try {
    run(squaresStudy(kItems), {file("all.csv"), {}}, stop_at_once);
    ADD_FAILURE() << "it was not stopped";
  } catch (const Stopped& stopped) {
    EXPECT_EQ(stopped.exitCode(), 128 + SIGTERM);
    EXPECT_EQ(stopped.what(),
              "stopped: " + file("all.csv.partial") + " has 16 of 50 answers; continue with --resume");
  }
  EXPECT_FALSE(exists("all.csv"));
  EXPECT_EQ(run({file("all.csv"), {}, true}).answered, kItems - 16);
  EXPECT_EQ(content("all.csv"), squaresTable(kItems));
}

TEST_F(StudyFiles, aLinkStaysALink) {
  folder_.write("far.csv", "earlier");
  std::filesystem::create_symlink("far.csv", file("near.csv"));
  run({file("near.csv"), {}});
  EXPECT_TRUE(std::filesystem::is_symlink(file("near.csv")));
  EXPECT_EQ(content("far.csv"), squaresTable(kItems));
}

TEST(ExactNumbers, areThoseOfStreamsAndReadBackAsTheyAre) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 10000; ++i) {
    const double fraction = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
    const double value = std::ldexp(fraction, static_cast<int>(random() % 200) - 100);
    std::ostringstream stream;
    stream << std::setprecision(17) << value;
    ASSERT_EQ(exactText(value), stream.str());
    ASSERT_EQ(std::stod(exactText(value)), value);
  }
  EXPECT_EQ(exactText(0.0), "0");
  EXPECT_EQ(exactText(1.0), "1");
}

TEST(StopSignal, notesTheFirstSignalAndGivesTheHandlerBack) {
  struct sigaction before = {}, after = {};
  sigaction(SIGINT, nullptr, &before);
  {
    const StopSignal watch;
    EXPECT_EQ(StopSignal::received(), 0);
    std::raise(SIGINT);
    EXPECT_EQ(StopSignal::received(), SIGINT);
  }
  sigaction(SIGINT, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
}

}  // namespace
}  // namespace octoblisk::demos
