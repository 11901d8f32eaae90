// The bits of trees and answers, committed as hashes. Every compiler, build type, instruction set and number
// of threads must give these hashes. If a change alters them on purpose, copy the new ones from the failing
// test and say so in the commit.
#include <gtest/gtest.h>

#include <string>

#include "core/golden_answers.h"
#include "core/only_targets.h"

namespace octoblisk {
namespace {

using testing::Golden;
using testing::GoldenAnswers;
using testing::GoldenScene;
using testing::OnlyTargets;

const std::vector<Golden> kGolden = {
    {"trees", 0xc54df0b319714587u},
    {"fast trees", 0x701da22c4a6dae99u},
    {"compact trees", 0x30ca30e72b8b6d89u},
    {"the paper's trees", 0x0961698504aa900fu},
    {"refit", 0x1fd26bcd04a94a91u},
    {"collide", 0xa04db54337ff6557u},
    {"collide with a soup", 0x658ade419266cf24u},
    {"touching pairs", 0xe1041353fecff6c5u},
    {"touching pairs with a soup", 0x5bd1d512cd2585d6u},
    {"contacts", 0xb36e19ff854bcb3fu},
    {"contacts with a soup", 0x78eddf4b86c8b69bu},
    {"contacts of a source", 0x6e82fb0fffdae8a9u},
    {"clusters near", 0x54117287cd9e1209u},
    {"contacts of convex bodies", 0x2aa667decd7d4f1bu},
    {"distance", 0xaa8c29cdea143249u},
    {"rays", 0x1547be03d967fea6u},
    {"motions", 0x1fb52bb0b97a4cb1u},
    {"sweeps", 0xd792c3650844c504u},
    {"sweeps of convex bodies", 0x94e319468c3f69e1u},
    {"solids", 0x50a1275bcae39306u},
    {"solids with defects", 0x62c928f54a11cfd6u},
};

std::string written(const std::vector<Golden>& golden) {
  std::string text;
  char line[80];
  for (const Golden& one : golden) {
    std::snprintf(line, sizeof line, "    {\"%s\", 0x%016llxu},\n", one.of,
                  static_cast<unsigned long long>(one.hash));
    text += line;
  }
  return text;
}

/// With FMA enabled in the compiler, Eigen fuses products and sums, which changes the last bits.
#ifdef __FMA__
constexpr bool kFused = true;
#else
constexpr bool kFused = false;
#endif

void expectGolden(const GoldenAnswers& found) { EXPECT_EQ(written(found.hashes), written(kGolden)); }

TEST(Golden, isTheSameForAnyNumberOfThreads) {
  if (kFused) GTEST_SKIP() << "compiled with -mfma";
  const GoldenScene scene;
  for (const int threads : {1, 5}) {
    const GoldenAnswers found = goldenAnswers(scene, threads);
    expectGolden(found);
    EXPECT_GT(found.hits, scene.poses.size() * 3 / 10);
    EXPECT_LT(found.hits, scene.poses.size() * 7 / 10);
    EXPECT_GT(found.share_near, 0.3);
    EXPECT_LT(found.share_near, 0.9);
  }
}

TEST(Golden, isTheSameOnEveryInstructionSet) {
  if (kFused) GTEST_SKIP() << "compiled with -mfma";
  const GoldenScene scene;
  std::vector<std::int64_t> targets = testing::compiledTargets();
  targets.erase(targets.begin());  // the best one is the default, which other tests use
  for (const std::int64_t target : targets) {
    const OnlyTargets only(target);
    SCOPED_TRACE(::testing::Message() << std::hex << target);
    expectGolden(goldenAnswers(scene, 0));
  }
}

}  // namespace
}  // namespace octoblisk
