// Hands out the unanswered items of a study piece by piece.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "study/study.h"

namespace octoblisk::demos {

/// Hands out whole groups of a study, in order.
class Handout {
 public:
  /// The ranges must ascend and begin with whole groups.
  Handout(std::vector<ItemRange> ranges, std::size_t group);

  /// The next groups: at least one, at most this many; empty if none are left.
  ItemRange next(std::size_t groups);

  std::size_t groupsLeft() const;
  void clear() { next_range_ = ranges_.size(); }

 private:
  std::vector<ItemRange> ranges_;
  std::size_t group_;
  std::size_t next_range_ = 0;
};

/// The number of groups to answer at a time: enough to be efficient, few enough that an interruption loses
/// little.
class Pace {
 public:
  std::size_t groups() const { return groups_; }

  void took(std::chrono::duration<double> time) {
    constexpr std::chrono::duration<double> kShort{0.05}, kLong{0.5};
    constexpr std::size_t kMaxGroups = 4096;
    if (time < kShort && groups_ < kMaxGroups) groups_ *= 2;
    if (time > kLong && groups_ > 1) groups_ /= 2;
  }

 private:
  std::size_t groups_ = 4;
};

}  // namespace octoblisk::demos
