// Compares sets with the connections that joined them.
#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace octoblisk {

using namespace detail;

namespace {

TEST(DisjointSets, areConnected_vs_searchOfAllNumbers) {
  constexpr std::uint32_t kCount = 60;
  std::mt19937_64 random(110);
  DisjointSets sets;
  std::size_t connected = 0, all = 0;
  for (int round = 0; round < 40; ++round) {
    sets.reset(kCount);
    std::vector<std::uint32_t> set_of(kCount);  // relabelled at each connection
    std::iota(set_of.begin(), set_of.end(), 0u);
    for (int k = 0; k < 2 * round; ++k) {
      const auto from = static_cast<std::uint32_t>(random() % kCount),
                 into = static_cast<std::uint32_t>(random() % kCount);
      const std::uint32_t root = sets.rootOf(into);
      sets.join(from, into);
      EXPECT_EQ(sets.rootOf(from), root);
      std::ranges::replace(set_of, std::uint32_t(set_of[from]), std::uint32_t(set_of[into]));
    }
    for (std::uint32_t a = 0; a < kCount; ++a) {
      EXPECT_TRUE(sets.isRoot(sets.rootOf(a)));
      for (std::uint32_t b = 0; b < a; ++b) {
        const bool are_connected = sets.rootOf(a) == sets.rootOf(b);
        ASSERT_EQ(are_connected, set_of[a] == set_of[b]) << round << ": " << a << ", " << b;
        connected += are_connected;
        ++all;
      }
    }
  }
  EXPECT_GT(10 * connected, all);
  EXPECT_LT(2 * connected, all);
}

}  // namespace
}  // namespace octoblisk
