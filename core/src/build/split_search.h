// The data of SplitFinder's arithmetic: plain arrays, eight triangles side by side.
#pragma once

#include <cstdint>
#include <vector>

#include "simd/box8.h"

namespace octoblisk::detail {

/// The effort to spend on a split.
struct SplitEffort {
  int samples = 1024;   ///< the most triangles to use, up to SplitFinder::kMaxSamples
  int lloyd_steps = 8;  ///< from each seed
  /// 1..3: perpendicular to the longest, middle and thinnest axis of the box. One more seed is the direction
  /// in which most triangles face.
  int axis_seeds = 3;
  int one_seed_below = 0;   ///< fewer triangles than this use the first seed only
  bool refine_turn = true;  ///< turn the boxes in steps of 3° instead of 13°
};

/// Eight triangles side by side, in the frame in which splits are found: centred and scaled to about ±1.
/// Unused lanes are zero.
struct alignas(64) TriangleBlock {
  float corner[3][3][kLanes];  ///< [corner][component]
  float feature[6][kLanes];    ///< centroid and weighted normal
  float present[kLanes];       ///< 1, or 0 for an unused lane
};

struct SplitSearch {
  static constexpr int kMaxSeeds = 4;

  /// The box of a side.
  struct Side {
    float axes[3][3];       ///< [axis][component]: the third is the thinnest
    float low[3], high[3];  ///< along the axes
  };
  struct Candidate {
    float normal[6];  ///< separates features f with normal·f < offset from the others
    float offset;
    float error;
    float volume;
    Side sides[2];  ///< low, high
  };

  // Input:
  int count = 0;
  float slack = 0.0f;
  SplitEffort effort;
  int seed_count = 0;  ///< of seed_axes
  float seed_axes[3][3];
  bool has_normal_seed = false;

  // Output: candidates[best] with the sides into which it divides the triangles; best < 0 if no candidate has
  // two sides.
  int best = -1;
  Candidate candidates[kMaxSeeds];

  std::vector<TriangleBlock> blocks;
  std::vector<float> is_low[kMaxSeeds];  ///< 1 or 0 for each triangle of the blocks

  int candidate_count = 0;
  std::vector<float> moments;          ///< nine rows of eight per block
  std::vector<std::uint16_t> side[2];  ///< of the current candidate, as indices of triangles

  std::size_t blockCount() const { return (static_cast<std::size_t>(count) + kLanes - 1) / kLanes; }
};

/// Finds the best candidate: k-means with k = 2 from each seed, then boxes around the two sides.
void findSplit(SplitSearch& search);

}  // namespace octoblisk::detail
