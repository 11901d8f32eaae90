// Collects pairs of triangles that are near each other, and not many more than matter.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "query/near_pair.h"

namespace octoblisk::detail {

/// Where two fine meshes touch, the number of pairs within a threshold grows with the square of the number of
/// triangles. If the pairs become many, the reach shrinks, and pairs beyond it are dropped.
class NearPairCollector {
 public:
  /// Replaces the content of `pairs`. The reach is `threshold` at first; it stays at least `surplus` beyond
  /// the nearest pair.
  NearPairCollector(std::vector<NearPair>& pairs, double threshold, double surplus)
      : pairs_(pairs), reach_(threshold), surplus_(surplus) {
    pairs_.clear();
  }

  /// Pairs that are farther apart need not be added.
  double reach() const { return reach_; }

  void add(const NearPair& pair) {
    pairs_.push_back(pair);
    nearest_ = std::min(nearest_, double(pair.most_distance));
    if (pairs_.size() >= many_) shrink();
  }

 private:
  static constexpr std::size_t kMany = 16384;

  /// Keeps the nearest kMany / 2 pairs, and all that are within the surplus.
  void shrink() {
    const auto middle = pairs_.begin() + kMany / 2;
    std::ranges::nth_element(pairs_, middle, {}, &NearPair::least_distance);
    reach_ = std::min(reach_, std::max(double(middle->least_distance), nearest_ + surplus_));
    std::erase_if(pairs_, [&](const NearPair& pair) { return double(pair.least_distance) > reach_; });
    many_ = std::max(kMany, 2 * pairs_.size());
  }

  std::vector<NearPair>& pairs_;
  double reach_;
  const double surplus_;
  double nearest_ = std::numeric_limits<double>::infinity();  // an upper bound of the least distance
  std::size_t many_ = kMany;
};

}  // namespace octoblisk::detail
