// The to-do list of a search for the nearest pair. Entries that are proved to be farther are never visited.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "query/traversal_stack.h"

namespace octoblisk::detail {

/// Returns the entry with the least gap first, until a few pairs of leaves have shown about how near the
/// nearest pair is, or the queue is full. Then it returns the rest depth first, because a stack has enough
/// room for that and needs no ordering.
template <typename Entry, int kLevels>
class TraversalQueue {
 public:
  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }

  Entry pop() {
    if (inOrder()) std::pop_heap(entries_.begin(), end(), fartherFirst);
    return entries_[--count_];
  }

  /// Like TraversalStack's.
  void pushSorted(std::size_t first, const Entry& entry) {
    if (inOrder() && count_ == kRoom) endOrder(std::numeric_limits<float>::infinity());
    if (inOrder()) {
      entries_[count_++] = entry;
      std::push_heap(entries_.begin(), end(), fartherFirst);
    } else {
      assert(count_ < entries_.size());
      entries_[count_++] = entry;
      sinkLast(entries_.data(), first, count_);
    }
  }

  /// The entry popped last is too far away, and so are all others in the heap.
  void dismiss() {
    if (inOrder()) count_ = 0;
  }

  /// The entry popped last was a pair of leaves that have been tested. From now on, entries beyond the limit
  /// are irrelevant.
  void sawLeaves(float limit) {
    if (inOrder() && --leaves_to_see_ == 0) endOrder(limit);
  }

 private:
  static constexpr std::size_t kRoom = 1024;

  static bool fartherFirst(const Entry& a, const Entry& b) { return a.gap > b.gap; }

  bool inOrder() const { return leaves_to_see_ > 0; }
  auto end() { return entries_.begin() + static_cast<std::ptrdiff_t>(count_); }

  /// Turns the heap into a stack of the entries within the limit, least gap on top.
  void endOrder(float limit) {
    leaves_to_see_ = 0;
    const auto near =
        std::partition(entries_.begin(), end(), [&](const Entry& entry) { return !(entry.gap > limit); });
    count_ = static_cast<std::size_t>(near - entries_.begin());
    std::sort(entries_.begin(), end(), fartherFirst);
  }

  std::array<Entry, kRoom + (kLanes - 1) * kLevels + kLanes> entries_;  // a heap, later a stack
  std::size_t count_ = 0;
  int leaves_to_see_ = 3;
};

}  // namespace octoblisk::detail
