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
    {"trees", 0x447e31c7447d96c4u},
    {"fast trees", 0x662203d57c6b37ffu},
    {"compact trees", 0xcf2e022770227a7cu},
    {"the paper's trees", 0xbdd37a5ccc792fc0u},
    {"refit", 0x12ec88cbd4799816u},
    {"collide", 0xb26d2f877a3cbb3bu},
    {"collide with a soup", 0x60f3a3c57a5449bbu},
    {"touching pairs", 0xe1041353fecff6c5u},
    {"touching pairs with a soup", 0x5bd1d512cd2585d6u},
    {"contacts", 0xb36e19ff854bcb3fu},
    {"contacts with a soup", 0x78eddf4b86c8b69bu},
    {"contacts of a source", 0x6e82fb0fffdae8a9u},
    {"clusters near", 0x24d4d8a04287b03au},
    {"contacts of convex bodies", 0x58664b8f0bb4cd9au},
    {"distance", 0xace9156dbe811757u},
    {"rays", 0x1547be03d967fea6u},
    {"motions", 0xb57082999be5c340u},
    {"sweeps", 0x78529b7a550b8faeu},
    {"sweeps of convex bodies", 0x4a5dd4c4e8e737cfu},
    {"solids", 0x50a1275bcae39306u},
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
