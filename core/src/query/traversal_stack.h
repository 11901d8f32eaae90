// The to-do list of a traversal of the trees.
#pragma once

#include <array>
#include <cassert>

#include "simd/box8.h"

namespace octoblisk::detail {

/// Moves the last of `count` entries to its place among those since `first`, which are sorted by descending
/// gap.
template <typename Entry>
void sinkLast(Entry* entries, std::size_t first, std::size_t count) {
  std::size_t place = count - 1;
  if (place == first || !(entries[place - 1].gap < entries[place].gap)) return;
  const Entry entry = entries[place];
  for (; place > first && entries[place - 1].gap < entry.gap; --place) entries[place] = entries[place - 1];
  entries[place] = entry;
}

/// The to-do list of a traversal. It starts with at most eight times eight entries. Each step replaces one
/// entry by at most eight, each with one box less above its leaves. Therefore it never overflows.
template <typename Entry, int kLevels>
class TraversalStack {
 public:
  bool empty() const { return count_ == 0; }
  const Entry& pop() { return entries_[--count_]; }

  void push(const Entry& entry) {
    assert(count_ < entries_.size());
    entries_[count_++] = entry;
  }
  /// Adds an entry so that those since `first` are popped by ascending gap.
  void pushSorted(std::size_t first, const Entry& entry) {
    push(entry);
    sinkLast(entries_.data(), first, count_);
  }
  std::size_t size() const { return count_; }

  /// The entry popped last is too far away. This says nothing about the remaining entries.
  void dismiss() {}
  /// Tested leaves say nothing about them either.
  void sawLeaves(float) {}

 private:
  std::array<Entry, (kLanes - 1) * kLevels + kLanes * kLanes> entries_;
  std::size_t count_ = 0;
};

}  // namespace octoblisk::detail
