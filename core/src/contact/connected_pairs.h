// Which triangle pairs of two surfaces are connected by shared triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "base/disjoint_sets.h"
#include "contact/surface_pair.h"

namespace octoblisk::detail {

/// Groups of triangle pairs: two pairs that share a triangle are in one group. Allocates nothing once warm.
class ConnectedPairs {
 public:
  /// Starts without pairs.
  void reset(const SurfacePair& surfaces) {
    first_of_b_ = surfaces.a.surface.size();
    triangles_.reset(first_of_b_ + surfaces.b.surface.size());
  }
  void add(const NumberPair& pair) { triangles_.join(first_of_b_ + pair.b, pair.a); }
  void add(const std::vector<NumberPair>& pairs) {
    for (const NumberPair& pair : pairs) add(pair);
  }

  /// The number of the group of a pair that was added, below size().
  std::uint32_t groupOf(const NumberPair& pair) { return triangles_.rootOf(pair.a); }
  std::size_t size() const { return triangles_.size(); }

 private:
  DisjointSets triangles_;  // of A, then of B
  std::uint32_t first_of_b_ = 0;
};

}  // namespace octoblisk::detail
