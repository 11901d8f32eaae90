// The to-do list of a walk that looks for the nearest: whatever is proved to be farther is never looked at.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "query/traversal_stack.h"

namespace octoblisk::detail {

/// Gives the entry of least gap, until a few pairs of leaves have told about how near the nearest is, or
/// there is no room for more; then what is left depth first, for which a stack is room enough, and which
/// spares the order.
template <typename Entry, int kLevels>
class TraversalQueue {
 public:
  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }

  Entry pop() {
    if (inOrder()) std::pop_heap(entries_.begin(), end(), fartherFirst);
    return entries_[--count_];
  }

  /// As TraversalStack's.
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

  /// What was popped last is too far: so is all that waits behind it in the heap.
  void dismiss() {
    if (inOrder()) count_ = 0;
  }

  /// What was popped last is a pair of leaves, which were looked at; what is farther than the limit does not
  /// matter from now on.
  void sawLeaves(float limit) {
    if (inOrder() && --leaves_to_see_ == 0) endOrder(limit);
  }

 private:
  static constexpr std::size_t kRoom = 1024;

  static bool fartherFirst(const Entry& a, const Entry& b) { return a.gap > b.gap; }

  bool inOrder() const { return leaves_to_see_ > 0; }
  auto end() { return entries_.begin() + static_cast<std::ptrdiff_t>(count_); }

  /// The heap becomes a stack of what is within the limit, the least gap on top.
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
