// Options for building a clustered octree.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/cpp20.h"

namespace octoblisk {

/// How the triangles of a node become its children.
enum class PartitionKind {
  clustering,  ///< recursive clustering in position–normal space: fastest queries
  paper,  ///< parts → k clusters → octree to a leaf capacity: the paper's method, for its experiments
};

/// How much time the clustering takes to find tight boxes.
enum class BuildQuality {
  high,  ///< the fastest queries
  low,   ///< less time to build, looser boxes: for meshes that change often
};

/// Trades the memory of the tree against the time of queries.
enum class Storage {
  full,     ///< about 60 bytes per triangle in addition to the mesh
  compact,  ///< a fifth of that: 16-bit integer boxes, corners read from the mesh; slower queries
};

struct BuildOptions {
  PartitionKind partition = PartitionKind::clustering;
  int leaf_capacity = 8;  ///< the most triangles in a leaf: 1..8; for `paper`, at least 1 (its FNOP)
  BuildQuality quality = BuildQuality::high;  ///< used by `clustering` only
  int threads = 0;  ///< of the build; 0: as many as the machine has. The tree does not depend on it
  Storage storage = Storage::full;
  // The remaining options are used by `paper` only.
  int clusters = 2;                        ///< k of each part, 1..8; 0: the best k of each part, from 2 to 8
  std::uint64_t seed = 1;                  ///< for k-means
  std::vector<int> part_of_triangle = {};  ///< e.g. blade numbers, one per triangle; empty: one part
};

}  // namespace octoblisk
