// Finds the best way to divide triangles in two: k-means with k = 2 from several seeds, judged by the boxes
// around the two sides.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "build/split_search.h"
#include "build/triangle_record.h"
#include "simd/box8.h"

namespace octoblisk::detail {

/// Finds splits. Reuses its memory for many ranges.
class SplitFinder {
 public:
  static constexpr int kMaxSamples = 1024;

  SplitFinder();

  struct Split {
    BoxF low, high;  ///< around the sampled triangles of each side
  };

  /// Divides the records that the indices refer to, whose box is given. `slack` is added to box edges when
  /// volumes are compared. None if no seed gives two sides.
  std::optional<Split> find(std::span<const TriangleRecord> records, std::span<const std::uint32_t> indices,
                            const BoxF& box, float slack, const SplitEffort& effort);

  /// Whether the last split used all records, so that `isLow(i)` returns the side of the i-th one.
  bool sawAll() const { return saw_all_; }
  bool isLow(std::size_t i) const { return search_.is_low[static_cast<std::size_t>(search_.best)][i] > 0.0f; }
  /// The side of any record: a plane in the space of centroids and normals.
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
