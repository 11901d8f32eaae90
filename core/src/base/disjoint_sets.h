// Which of many numbers are connected, directly or through others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace octoblisk::detail {

/// Disjoint sets of the numbers from 0, with path halving (R. Tarjan, J. van Leeuwen, 1984). Allocates
/// nothing once warm.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) { reset(count); }

  /// Makes each of the numbers 0 to count − 1 a set of its own.
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::size_t size() const { return parent_.size(); }

  /// The number that stands for all of its set.
  std::uint32_t rootOf(std::uint32_t number) {
    while (!isRoot(number)) number = parent_[number] = parent_[parent_[number]];
    return number;
  }
  bool isRoot(std::uint32_t number) const { return parent_[number] == number; }

  /// Joins two sets. The root of `into` becomes that of both.
  void join(std::uint32_t from, std::uint32_t into) { parent_[rootOf(from)] = rootOf(into); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace octoblisk::detail
