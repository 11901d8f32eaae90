// What SplitFinder's arithmetic works on: plain arrays, eight triangles side by side.
#pragma once

#include <cstdint>
#include <vector>

#include "simd/box8.h"

namespace octoblisk::detail {

/// How much effort a split is worth.
struct SplitEffort {
  int samples = 1024;       ///< triangles looked at, at most: up to SplitFinder::kMostSamples
  int lloyd_steps = 8;      ///< from each seed
  int axis_seeds = 3;       ///< 1..3: across the longest, middle and thinnest axis of the box
  bool normal_seed = true;  ///< one more: by the direction that the triangles face most
  int one_seed_below = 0;   ///< fewer triangles than this get the first seed alone
  bool refine_turn = true;  ///< turn the boxes in steps of 3° instead of 13°
};

/// Eight triangles side by side, in the frame that splits are found in: centred and scaled to about ±1. A
/// lane that is not used is all zeros.
struct alignas(64) TriangleBlock {
  float corner[3][3][kLanes];  ///< [corner][component]
  float feature[6][kLanes];    ///< centroid and weighted normal
  float present[kLanes];       ///< 1, or 0 where the block is not full
};

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
  std::vector<float> is_low[kMostSeeds];  ///< 1 or 0, a triangle of the blocks each

  int candidate_count = 0;
  std::vector<float> moments;          ///< nine rows of eight a block
  std::vector<std::uint16_t> side[2];  ///< of the candidate at hand, as indices of triangles

  std::size_t blockCount() const { return (static_cast<std::size_t>(count) + kLanes - 1) / kLanes; }
};

/// Finds the best candidate: k-means for k = 2 from each seed, then boxes round the two sides.
void findSplit(SplitSearch& search);

}  // namespace octoblisk::detail
