// The octrees of Tables 3 and 4 over the points of a blisk.
#pragma once

#include <span>
#include <vector>

#include "paper/segmentation.h"

namespace octoblisk::demos {

struct PaperOctrees {
  /// `parts` are clouds of the blisk's parts. Throws as clustersOfParts and Segmentation.
  PaperOctrees(std::span<const Points> parts, const detail::KMeansOptions& k_means, std::size_t fnop)
      : whole(joined(parts)),
        clusters(clustersOfParts(parts, k_means)),
        traditional(std::span(&whole, 1), fnop, CellFrame::box),
        improved(clusters, fnop, CellFrame::box) {}

  Points whole;
  std::vector<Points> clusters;
  Segmentation traditional;  ///< one octree over all points
  Segmentation improved;     ///< one octree over each cluster
};

}  // namespace octoblisk::demos
