// The to-do list of nearest searches is sorted by gap while it has room, and loses nothing when it is full.
#include "query/traversal_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

namespace octoblisk {

using namespace detail;

namespace {

struct Entry {
  int name;
  float gap;
};
using Queue = TraversalQueue<Entry, 2>;

TEST(TraversalQueue, givesTheLeastGapFirst) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<float> gap(-1.0f, 5.0f);
  const auto queue = std::make_unique<Queue>();
  for (int i = 0; i < 500; ++i) queue->pushSorted(queue->size(), {i, gap(random)});
  float last = -2.0f;
  int popped = 0;
  for (; !queue->empty(); ++popped) {
    const Entry entry = queue->pop();
    EXPECT_GE(entry.gap, last);
    last = entry.gap;
  }
  EXPECT_EQ(popped, 500);
}

TEST(TraversalQueue, losesNothingWhereRoomRunsOut) {
  // Like in a traversal, each popped entry adds three, until many more exist than fit.
  const auto queue = std::make_unique<Queue>();
  constexpr int kEntries = 9000;
  std::mt19937_64 random(32);
  std::uniform_real_distribution<float> gap(0.0f, 1.0f);
  std::vector<int> seen(kEntries, 0);
  int made = 0;
  std::vector<int> depth(kEntries, 0);
  const auto push = [&](std::size_t first, int level) {
    depth[static_cast<std::size_t>(made)] = level;
    queue->pushSorted(first, {made++, gap(random)});
  };
  for (int i = 0; i < 1020; ++i) push(queue->size(), 0);
  while (!queue->empty()) {
    const Entry entry = queue->pop();
    ++seen[static_cast<std::size_t>(entry.name)];
    const int level = depth[static_cast<std::size_t>(entry.name)];
    const std::size_t first = queue->size();
    for (int child = 0; child < 3 && level < 2 && made < kEntries; ++child) push(first, level + 1);
  }
  EXPECT_GT(made, 5000);
  for (int i = 0; i < made; ++i) ASSERT_EQ(seen[static_cast<std::size_t>(i)], 1) << i;
}

TEST(TraversalQueue, dismissesAllThatWaitsBehindTheLast) {
  const auto queue = std::make_unique<Queue>();
  for (int i = 0; i < 10; ++i) queue->pushSorted(queue->size(), {i, static_cast<float>(i)});
  EXPECT_EQ(queue->pop().name, 0);
  queue->dismiss();
  EXPECT_TRUE(queue->empty());
}

TEST(TraversalQueue, dismissesNothingOnceRoomRanOut) {
  const auto queue = std::make_unique<Queue>();
  for (int i = 0; i < 1025; ++i) queue->pushSorted(queue->size(), {i, 1.0f + 0.001f * static_cast<float>(i)});
  const std::size_t first = queue->size();
  queue->pushSorted(first, {2000, 5.0f});  // below the last popped gap
  EXPECT_EQ(queue->pop().name, 2000);
  queue->dismiss();
  EXPECT_EQ(queue->size(), 1025u);
}

TEST(TraversalQueue, goesOnDepthFirstOnceLeavesWereSeen) {
  const auto queue = std::make_unique<Queue>();
  std::mt19937_64 random(33);
  std::vector<int> names(20);
  std::iota(names.begin(), names.end(), 0);
  std::ranges::shuffle(names, random);
  for (const int name : names) queue->pushSorted(queue->size(), {name, static_cast<float>(name)});
  for (int leaf = 0; leaf < 3; ++leaf) {
    EXPECT_EQ(queue->pop().name, leaf);
    queue->sawLeaves(17.0f);
  }
  const std::size_t first = queue->size();
  queue->pushSorted(first, {102, 102.0f});
  queue->pushSorted(first, {101, 101.0f});
  queue->pushSorted(first, {103, 103.0f});
  for (const int name : {101, 102, 103}) EXPECT_EQ(queue->pop().name, name);
  queue->dismiss();
  for (int name = 3; name <= 17; ++name) EXPECT_EQ(queue->pop().name, name);
  EXPECT_TRUE(queue->empty());
}

}  // namespace
}  // namespace octoblisk
