// The experiment of Tables 1 and 2: a blade's cloud divided for each method and FNOP.
#pragma once

#include <array>
#include <span>

#include "paper/belt_poses.h"
#include "paper/method_table.h"
#include "paper/progress.h"
#include "paper/segmentation.h"

namespace octoblisk::demos {

struct SplitOptions {
  detail::KMeansOptions k_means{};  ///< of each k
  int repeats = 15;                 ///< of which split_ms is the median, interleaved over all cells
};

/// What a method does at an FNOP.
struct SplitCell {
  std::size_t nodes = 0;            ///< TNON
  double split_ms = 0.0;            ///< processor time to build the octrees of given clusters
  double leaf_volume = 0.0;         ///< of the leaf cells with points, mm³
  std::size_t false_positives = 0;  ///< clear poses at which the belt's box overlaps a leaf cell
  std::size_t false_negatives = 0;  ///< touching poses at which it overlaps none
};

struct SplitResult {
  MethodTable<SplitCell> cubes;               ///< along the axes, as the paper does it
  MethodTable<SplitCell> principal;           ///< boxes in principal frames
  std::array<double, kMethods> cluster_ms{};  ///< of k-means, the median; 0 for the traditional method
  std::size_t touching = 0, clear = 0;        ///< poses
};

/// One number of every cell.
template <typename Number>
MethodTable<Number> numbersOf(const MethodTable<SplitCell>& cells, Number SplitCell::*number) {
  MethodTable<Number> table{};
  for (std::size_t method = 0; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      table[method][column] = cells[method][column].*number;
    }
  }
  return table;
}

/// Divides the cloud of at least 8 points. The belt's box is its one box along its principal axes, in the
/// belt's frame; the poses' verdicts are on the cloud's mesh. All but the times is the same bits for the same
/// seed.
SplitResult runSplitExperiment(const Points& cloud, const Obb& belt_box, std::span<const BeltPose> poses,
                               const SplitOptions& options, const Progress& progress);

}  // namespace octoblisk::demos
