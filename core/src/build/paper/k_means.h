// k-means clustering of points (eq. 4–5 and steps 1–5 of the paper): seeded Lloyd iterations.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::detail {

struct KMeansOptions {
  std::size_t k = 2;         ///< number of clusters, 1..n
  std::uint64_t seed = 1;    ///< of the random initial centres (step 1)
  int max_iterations = 300;  ///< cap of one run
  /// Runs from other initial centres; that of the least S(C) counts, of equal ones the first. 1 is the
  /// paper's own start: the cluster means of a first run (section 4.1) are where that run has ended.
  int starts = 16;
};

struct Clustering {
  std::vector<std::uint32_t> cluster_of_point;
  std::vector<Vec3> centers;
  std::vector<std::uint32_t> sizes;
  double squared_error = 0.0;  ///< S(C), eq. 5
  int iterations = 0;          ///< of the run that counts
  bool converged = false;      ///< the assignment no longer changes
};

/// Clusters the points. Deterministic: the same bits for the same points and options. A point at equal
/// distance belongs to the lowest cluster. A cluster that runs empty takes the point farthest from its own
/// centre; one may stay empty where there are fewer than k distinct points, or where max_iterations ends the
/// run. Throws std::invalid_argument where k is not in 1..n, or max_iterations or starts is
/// below 1.
Clustering kMeans(std::span<const Vec3> points, const KMeansOptions& options = {});

}  // namespace octoblisk::detail
