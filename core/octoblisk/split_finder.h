// The best way to divide triangles in two: k-means for k = 2 from several seeds, judged by the boxes round
// the two sides.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "octoblisk/box8.h"
#include "octoblisk/triangle_record.h"

namespace octoblisk {

/// How much effort a split is worth.
struct SplitEffort {
  int samples = 1024;       ///< triangles looked at, at most: up to SplitFinder::kMostSamples
  int lloyd_steps = 8;      ///< from each seed
  int axis_seeds = 3;       ///< 1..3: across the longest, middle and thinnest axis of the box
  bool normal_seed = true;  ///< one more: by the direction that the triangles face most
  int one_seed_below = 0;   ///< fewer triangles than this get the first seed alone
  bool refine_turn = true;  ///< turn the boxes in steps of 3° instead of 13°
};

/// Eight triangles side by side, in the frame that splits are found in: centred and scaled to about ±1.
struct alignas(64) TriangleBlock {
  float corner[3][3][kLanes];     ///< [corner][component]
  float feature[6][kLanes];       ///< centroid and weighted normal
  std::uint32_t present[kLanes];  ///< all bits, or none where the block is not full
};

/// Plain arrays that the vector code works on; split_search.inc.
struct SplitSearch {
  static constexpr int kMostSeeds = 4;

  /// The box of a side.
  struct Side {
    float axes[3][3];       ///< [axis][component]: the third is the thinnest
    float low[3], high[3];  ///< along the axes
  };
  struct Candidate {
    float normal[6];  ///< divides features f into normal·f < offset and the rest
    float offset;
    float error;
    float volume;
    Side sides[2];  ///< low, high
  };

  // In:
  int count = 0;
  float slack = 0.0f;
  SplitEffort effort;
  int axis_seeds = 0;
  float seed_axes[3][3];
  bool normal_seed = false;

  // Out: candidates[best], with the sides that it divides the triangles into; best < 0 where none has two.
  int best = -1;
  Candidate candidates[kMostSeeds];

  std::vector<TriangleBlock> blocks;
  std::vector<std::uint32_t> is_low[kMostSeeds];  ///< all bits or none, a triangle of the blocks each

  int candidate_count = 0;
  std::vector<float> moments;          ///< nine rows of eight a block
  std::vector<std::uint16_t> side[2];  ///< of the candidate at hand, as indices of triangles
};

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
  bool isLow(std::size_t i) const { return search_.is_low[static_cast<std::size_t>(search_.best)][i] != 0; }
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

}  // namespace octoblisk
