#include "build/paper/part_clusters.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "build/paper/k_means.h"
#include "build/paper/k_opt.h"

namespace octoblisk::detail {
namespace {

std::size_t clusterCount(std::span<const Vec3> points, const PartClusterOptions& options) {
  constexpr std::size_t kMinK = 2, kMaxK = 8;
  if (options.clusters > 0 || points.size() < kMinK) return std::max<std::size_t>(options.clusters, 1);
  return optimalK(points, {.k_max = std::min(kMaxK, points.size()),
                           .leaf_capacity = options.leaf_capacity,
                           .seed = options.seed});
}

std::vector<TriangleSet> clustersOf(const TriangleSet& part, std::span<const Vec3> centroids,
                                    const PartClusterOptions& options) {
  std::vector<Vec3> points;
  points.reserve(part.size());
  for (const std::uint32_t t : part) points.push_back(centroids[t]);
  const std::size_t k = std::min(clusterCount(points, options), part.size());
  const Clustering clustering = kMeans(points, {.k = k, .seed = options.seed});
  std::vector<TriangleSet> clusters(k);
  for (std::size_t i = 0; i < part.size(); ++i) clusters[clustering.cluster_of_point[i]].push_back(part[i]);
  std::erase_if(clusters, [](const TriangleSet& cluster) { return cluster.empty(); });
  return clusters;
}

}  // namespace

std::vector<std::vector<TriangleSet>> partClusters(std::span<const Vec3> centroids,
                                                   const PartClusterOptions& options) {
  const std::vector<int>& part_of = options.part_of_triangle;
  if (!part_of.empty() && part_of.size() != centroids.size()) {
    throw std::invalid_argument("part_of_triangle has " + std::to_string(part_of.size()) + " entries for " +
                                std::to_string(centroids.size()) + " triangles");
  }
  std::map<int, TriangleSet> parts;
  for (std::uint32_t t = 0; t < centroids.size(); ++t) parts[part_of.empty() ? 0 : part_of[t]].push_back(t);
  std::vector<std::vector<TriangleSet>> clusters;
  clusters.reserve(parts.size());
  for (const auto& [number, part] : parts) clusters.push_back(clustersOf(part, centroids, options));
  return clusters;
}

}  // namespace octoblisk::detail
