// The best way to divide triangles in two: k-means for k = 2 from several seeds, judged by the boxes round
// the two sides.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "build/split_search.h"
#include "build/triangle_record.h"
#include "simd/box8.h"

namespace octoblisk::detail {

/// Finds splits; holds the room for it, so that one finder serves many ranges.
class SplitFinder {
 public:
  static constexpr int kMostSamples = 1024;

  SplitFinder();

  struct Split {
    BoxF low, high;  ///< round the sampled triangles of the two sides
  };

  /// Divides the records that the indices name, whose box is given; `slack` is added to box edges while
  /// volumes are compared. None where no seed has two sides.
  std::optional<Split> find(std::span<const TriangleRecord> records, std::span<const std::uint32_t> indices,
                            const BoxF& box, float slack, const SplitEffort& effort);

  /// Of the split found last: whether all records were looked at, so that `isLow(i)` tells the i-th one's
  /// side.
  bool sawAll() const { return saw_all_; }
  bool isLow(std::size_t i) const { return search_.is_low[static_cast<std::size_t>(search_.best)][i] > 0.0f; }
  /// The same for any record: the plane in the space of centroids and normals.
  struct Plane {
    Eigen::Vector3f of_centroid, of_normal;
    float offset;
    bool isLow(const TriangleRecord& record) const {
      return of_centroid.dot(record.centroid) + of_normal.dot(record.normal) < offset;
    }
  };
  const Plane& plane() const { return plane_; }

 private:
  void fill(std::span<const TriangleRecord> records, std::span<const std::uint32_t> indices,
            const Eigen::Vector3f& center, float scale, int samples);
  void chooseSeeds(const BoxF& box);

  SplitSearch search_;
  Plane plane_;
  bool saw_all_ = false;
};

}  // namespace octoblisk::detail
