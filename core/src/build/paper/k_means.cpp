#include "build/paper/k_means.h"

#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>

namespace octoblisk::detail {
namespace {

/// k different points, drawn by the first k steps of a Fisher–Yates shuffle (step 1).
std::vector<Vec3> randomCenters(std::span<const Vec3> points, std::size_t k, std::mt19937_64& random) {
  std::vector<std::uint32_t> index(points.size());
  std::iota(index.begin(), index.end(), 0u);
  std::vector<Vec3> centers;
  for (std::size_t i = 0; i < k; ++i) {
    std::swap(index[i], index[i + random() % (points.size() - i)]);
    centers.push_back(points[index[i]]);
  }
  return centers;
}

/// Step 2: assigns every point to its nearest centre. Returns whether any point changed its cluster.
bool assign(std::span<const Vec3> points, Clustering& clustering) {
  bool changed = false;
  clustering.squared_error = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (std::uint32_t c = 0; c < clustering.centers.size(); ++c) {
      const double squared = (points[i] - clustering.centers[c]).squaredNorm();
      if (squared < least) {
        least = squared;
        nearest = c;
      }
    }
    changed |= clustering.cluster_of_point[i] != nearest;
    clustering.cluster_of_point[i] = nearest;
    clustering.squared_error += least;
  }
  return changed;
}

/// Step 3: moves every centre to the mean of its points. An empty cluster keeps its centre.
void moveCenters(std::span<const Vec3> points, Clustering& clustering) {
  std::vector<Vec3> sum(clustering.centers.size(), Vec3::Zero());
  clustering.sizes.assign(clustering.centers.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum[clustering.cluster_of_point[i]] += points[i];
    ++clustering.sizes[clustering.cluster_of_point[i]];
  }
  for (std::size_t c = 0; c < clustering.centers.size(); ++c) {
    if (clustering.sizes[c] > 0) clustering.centers[c] = sum[c] / clustering.sizes[c];
  }
}

/// Gives the first empty cluster the point that is farthest from its centre. Returns whether it did.
bool fillEmptyCluster(std::span<const Vec3> points, Clustering& clustering) {
  for (std::size_t c = 0; c < clustering.centers.size(); ++c) {
    if (clustering.sizes[c] > 0) continue;
    double most = 0.0;
    std::size_t farthest = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double squared = (points[i] - clustering.centers[clustering.cluster_of_point[i]]).squaredNorm();
      if (squared > most) {
        most = squared;
        farthest = i;
      }
    }
    if (farthest == points.size()) return false;  // fewer distinct points than clusters
    clustering.centers[c] = points[farthest];
    return true;
  }
  return false;
}

Clustering lloyd(std::span<const Vec3> points, std::vector<Vec3> centers) {
  constexpr int kMaxSteps = 300;
  Clustering clustering;
  clustering.centers = std::move(centers);
  clustering.cluster_of_point.assign(points.size(), std::numeric_limits<std::uint32_t>::max());
  for (int i = 0; i < kMaxSteps && !clustering.converged; ++i) {
    const bool changed = assign(points, clustering);
    moveCenters(points, clustering);
    clustering.converged = !fillEmptyCluster(points, clustering) && !changed;
  }
  if (!clustering.converged) {
    assign(points, clustering);
    moveCenters(points, clustering);
  }
  return clustering;
}

}  // namespace

Clustering kMeans(std::span<const Vec3> points, const KMeansOptions& options) {
  if (options.k < 1 || options.k > points.size()) {
    throw std::invalid_argument("k-means: k is " + std::to_string(options.k) +
                                ", but must be 1 to the number of points, " + std::to_string(points.size()));
  }
  if (options.starts < 1) throw std::invalid_argument("k-means: starts must be at least 1");
  std::mt19937_64 random(options.seed);
  Clustering best = lloyd(points, randomCenters(points, options.k, random));
  for (int start = 1; start < options.starts && options.k > 1; ++start) {
    Clustering other = lloyd(points, randomCenters(points, options.k, random));
    if (other.squared_error < best.squared_error) best = std::move(other);
  }
  return best;
}

}  // namespace octoblisk::detail
