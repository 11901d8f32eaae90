// k-means clustering of points (eq. 4–5 and steps 1–5 of the paper): seeded Lloyd iterations.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::detail {

struct KMeansOptions {
  std::size_t k = 2;       ///< number of clusters, 1..n
  std::uint64_t seed = 1;  ///< for the random initial centres (step 1)
  /// The number of runs from different initial centres. The run with the least S(C) is returned, the first of
  /// equal ones. 1 gives the paper's result: the paper starts a second run from the cluster means of a first
  /// one (section 4.1), but the first run has already converged to these means.
  int starts = 16;
};

struct Clustering {
  std::vector<std::uint32_t> cluster_of_point;
  std::vector<Vec3> centers;
  std::vector<std::uint32_t> sizes;
  double squared_error = 0.0;  ///< S(C), eq. 5
  bool converged = false;      ///< the assignment no longer changes; false after 300 iterations
};

/// Clusters the points. Deterministic: equal points and options give equal bits. A point at equal distance
/// from several centres belongs to the lowest cluster. A cluster that becomes empty takes the point that is
/// farthest from its own centre. A cluster may stay empty if there are fewer than k distinct points, or if
/// the run has not converged. Throws std::invalid_argument if k is not in 1..n, or if starts is below 1.
Clustering kMeans(std::span<const Vec3> points, const KMeansOptions& options = {});

}  // namespace octoblisk::detail
