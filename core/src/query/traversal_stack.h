// The to-do list of a walk down the trees.
#pragma once

#include <array>
#include <cassert>

#include "simd/box8.h"

namespace octoblisk::detail {

/// Puts the last of so many entries where it belongs among those since `first`, which are by descending gap.
template <typename Entry>
void sinkLast(Entry* entries, std::size_t first, std::size_t count) {
  const Entry entry = entries[count - 1];
  std::size_t place = count - 1;
  for (; place > first && entries[place - 1].gap < entry.gap; --place) entries[place] = entries[place - 1];
  entries[place] = entry;
}

/// The walk's to-do list. It begins with at most eight times eight entries; then one is taken and at most
/// eight are put for it, and each has a box less above its leaves: this never overflows.
template <typename Entry, int kLevels>
class TraversalStack {
 public:
  bool empty() const { return count_ == 0; }
  const Entry& pop() { return entries_[--count_]; }

  /// Puts an entry so that those since `first` come out by ascending gap.
  void pushSorted(std::size_t first, const Entry& entry) {
    assert(count_ < entries_.size());
    entries_[count_++] = entry;
    sinkLast(entries_.data(), first, count_);
  }
  std::size_t size() const { return count_; }

  /// What was popped last is too far: nothing follows from that for those that wait.
  void dismiss() {}
  /// Nor from what it looked at.
  void sawLeaves(float) {}

 private:
  std::array<Entry, (kLanes - 1) * kLevels + kLanes * kLanes> entries_;
  std::size_t count_ = 0;
};

}  // namespace octoblisk::detail
