// The to-do list of a walk that looks for the nearest: whatever is proved to be farther is never looked at.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>

#include "octoblisk/traversal_stack.h"

namespace octoblisk {

/// Gives the entry of least gap, as long as there is room for many; then what is below the entry at hand is
/// done depth first, for which a stack is room enough.
template <typename Entry, int kLevels>
class TraversalQueue {
 public:
  bool empty() const { return count_ == 0 && stack_.empty(); }

  Entry pop() {
    waits_in_order_ = stack_.empty();
    if (!waits_in_order_) return stack_.pop();
    std::pop_heap(entries_.begin(), entries_.begin() + count_, fartherFirst);
    return entries_[static_cast<std::size_t>(--count_)];
  }

  std::size_t size() const { return stack_.size(); }

  void pushSorted(std::size_t first, const Entry& entry) {
    if (!stack_.empty() || count_ == kRoom) {
      stack_.pushSorted(first, entry);
      return;
    }
    entries_[static_cast<std::size_t>(count_++)] = entry;
    std::push_heap(entries_.begin(), entries_.begin() + count_, fartherFirst);
  }

  /// What was popped last is too far: so is all that waits behind it in the heap.
  void dismiss() {
    if (waits_in_order_) count_ = 0;
  }

 private:
  static constexpr std::ptrdiff_t kRoom = 1024;

  static bool fartherFirst(const Entry& a, const Entry& b) { return a.gap > b.gap; }

  std::array<Entry, kRoom> entries_;  // a heap
  std::ptrdiff_t count_ = 0;
  bool waits_in_order_ = true;  // behind what was popped last
  TraversalStack<Entry, kLevels> stack_;
};

}  // namespace octoblisk
