// The paper's segmentation of a point cloud: clusters, and an octree over each (sections 2.3 and 3.2).
#pragma once

#include <span>
#include <vector>

#include "build/paper/k_means.h"
#include "build/paper/octree.h"
#include "paper/paper_model.h"

namespace octoblisk::demos {

/// The frame and shape of an octree's root cell (erratum 9: the paper does not say).
enum class CellFrame {
  cube,           ///< a cube along the axes that the points are given in
  box,            ///< the points' own box along these axes
  principal_box,  ///< the points' box along their principal axes, for each cluster separately
};

/// Divides points into k clusters by k-means and leaves out empty ones. For k = 0, the traditional method,
/// all points form one cluster. Throws as kMeans.
std::vector<Points> clustersOf(const Points& points, const detail::KMeansOptions& options);

/// The clusters of several clouds, in one list; a cloud with fewer than k points gets as many clusters as it
/// has points.
std::vector<Points> clustersOfParts(std::span<const Points> parts, const detail::KMeansOptions& options);

/// All points of several clouds.
Points joined(std::span<const Points> parts);

class Segmentation {
 public:
  /// Builds an octree over each cluster. Throws std::invalid_argument without points, or for an FNOP of 0.
  Segmentation(std::span<const Points> clusters, std::size_t fnop, CellFrame frame);

  const std::vector<detail::Octree>& octrees() const { return octrees_; }

  std::size_t totalNodes() const;  ///< TNON: k + 8 · splits
  double rootVolume() const;       ///< of all roots, mm³
  double leafVolume() const;       ///< of all leaf cells with points, mm³
  std::vector<Obb> leafCells() const;

 private:
  std::vector<detail::Octree> octrees_;
};

/// The octrees of Tables 3 and 4 over the points of a blisk.
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
