#include "paper/segmentation.h"

#include <algorithm>
#include <utility>

#include "build/paper/principal_box.h"
#include "geometry/principal_axes.h"

namespace octoblisk::demos {

using namespace detail;

std::vector<Points> clustersOf(const Points& points, const KMeansOptions& options) {
  if (options.k == 0) return {points};
  const Clustering clustering = kMeans(points, options);
  std::vector<Points> clusters(options.k);
  for (std::size_t i = 0; i < points.size(); ++i) {
    clusters[clustering.cluster_of_point[i]].push_back(points[i]);
  }
  std::erase_if(clusters, [](const Points& cluster) { return cluster.empty(); });
  return clusters;
}

std::vector<Points> clustersOfParts(std::span<const Points> parts, const KMeansOptions& options) {
  std::vector<Points> all;
  for (const Points& part : parts) {
    KMeansOptions of_part = options;
    of_part.k = std::min(options.k, part.size());
    for (Points& cluster : clustersOf(part, of_part)) all.push_back(std::move(cluster));
  }
  return all;
}

Points joined(std::span<const Points> parts) {
  Points whole;
  for (const Points& part : parts) whole.insert(whole.end(), part.begin(), part.end());
  return whole;
}

Segmentation::Segmentation(std::span<const Points> clusters, std::size_t fnop, CellFrame frame) {
  octrees_.reserve(clusters.size());
  for (const Points& cluster : clusters) {
    OctreeOptions options{.leaf_capacity = fnop, .cubic = frame == CellFrame::cube};
    if (frame == CellFrame::principal_box) options.axes = principalAxes(covariance(cluster));
    octrees_.push_back(Octree::build(cluster, options));
  }
}

std::size_t Segmentation::totalNodes() const {
  std::size_t sum = 0;
  for (const Octree& octree : octrees_) sum += octree.stats().total_nodes;
  return sum;
}

double Segmentation::rootVolume() const {
  double sum = 0.0;
  for (const Octree& octree : octrees_) sum += octree.stats().root_volume;
  return sum;
}

double Segmentation::leafVolume() const {
  double sum = 0.0;
  for (const Octree& octree : octrees_) sum += octree.stats().leaf_volume;
  return sum;
}

std::vector<Obb> Segmentation::leafCells() const {
  std::vector<Obb> cells;
  for (const Octree& octree : octrees_) {
    for (const Octree::Node& node : octree.nodes()) {
      if (node.isLeaf() && node.count() > 0) cells.push_back(octree.cell(node));
    }
  }
  return cells;
}

}  // namespace octoblisk::demos
