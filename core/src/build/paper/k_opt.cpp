#include "build/paper/k_opt.h"

#include <limits>
#include <stdexcept>
#include <vector>

#include "build/paper/k_means.h"
#include "build/paper/octree.h"

namespace octoblisk::detail {

std::size_t optimalK(std::span<const Vec3> points, const KOptOptions& options) {
  constexpr std::size_t kMinK = 2;
  if (options.k_max < kMinK || options.k_max > points.size()) {
    throw std::invalid_argument("k_opt: the greatest k must lie between 2 and the number of points");
  }
  std::size_t best = 0, fewest = std::numeric_limits<std::size_t>::max();
  for (std::size_t k = kMinK; k <= options.k_max; ++k) {
    const Clustering clustering = kMeans(points, {.k = k, .seed = options.seed});
    std::size_t nodes = 0;
    for (std::uint32_t c = 0; c < k; ++c) {
      std::vector<Vec3> cluster;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (clustering.cluster_of_point[i] == c) cluster.push_back(points[i]);
      }
      if (cluster.empty()) continue;
      nodes += Octree::build(cluster, {.leaf_capacity = options.leaf_capacity}).stats().total_nodes;
    }
    if (nodes < fewest) {
      fewest = nodes;
      best = k;
    }
  }
  return best;
}

}  // namespace octoblisk::detail
