#include "build/paper/k_opt.h"

#include <algorithm>
#include <stdexcept>

#include "build/paper/k_means.h"
#include "build/paper/octree.h"
#include "build/paper/principal_box.h"
#include "geometry/principal_axes.h"

namespace octoblisk::detail {
namespace {

double clusterCost(std::span<const Vec3> points, const KOptOptions& options) {
  OctreeOptions octree{.leaf_capacity = options.leaf_capacity};
  if (options.criterion == KCriterion::least_nodes) {
    return static_cast<double>(Octree::build(points, octree).stats().total_nodes);
  }
  octree.axes = principalAxes(covariance(points));
  return Octree::build(points, octree).stats().leaf_volume;
}

}  // namespace

KOpt optimalK(std::span<const Vec3> points, const KOptOptions& options) {
  if (options.k_min < 1 || options.k_min > options.k_max || options.k_max > points.size()) {
    throw std::invalid_argument("k_opt: the range of k must lie between 1 and the number of points");
  }
  KOpt result;
  for (std::size_t k = options.k_min; k <= options.k_max; ++k) {
    const Clustering clustering = kMeans(points, {.k = k, .seed = options.seed});
    double cost = 0.0;
    for (std::uint32_t c = 0; c < k; ++c) {
      std::vector<Vec3> cluster;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (clustering.cluster_of_point[i] == c) cluster.push_back(points[i]);
      }
      if (!cluster.empty()) cost += clusterCost(cluster, options);
    }
    result.cost.push_back(cost);
  }
  result.k =
      options.k_min + static_cast<std::size_t>(std::ranges::min_element(result.cost) - result.cost.begin());
  return result;
}

}  // namespace octoblisk::detail
