// What a caller may choose about the build of a clustered octree.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/cpp20.h"

namespace octoblisk {

/// How the triangles of a node become its children.
enum class PartitionKind {
  clustering,  ///< recursive clustering in position–normal space: fastest queries
  paper,       ///< parts → k clusters → octree to a leaf capacity: the paper's, for its experiments
};

/// How much time the clustering takes to find tight boxes.
enum class BuildQuality {
  high,  ///< the fastest queries
  low,   ///< less time to build, looser boxes: for meshes that change often
};

/// What the tree takes of memory, and queries of time.
enum class Storage {
  full,     ///< about 60 bytes a triangle beside the mesh
  compact,  ///< a fifth of that: boxes of sixteen-bit integers, corners read from the mesh; slower queries
};

struct BuildOptions {
  PartitionKind partition = PartitionKind::clustering;
  int leaf_capacity = 8;  ///< most triangles in a leaf: 1..8; for `paper` the FNOP, at least 1
  BuildQuality quality = BuildQuality::high;  ///< of `clustering`
  int threads = 0;  ///< that build: 0 for as many as the machine has; the tree is the same to the last bit
  Storage storage = Storage::full;
  // The rest is for `paper` alone.
  int clusters = 2;                        ///< k, 1..8, for each part; 0: k_opt of each part, from 2 to 8
  std::uint64_t seed = 1;                  ///< of k-means
  std::vector<int> part_of_triangle = {};  ///< e.g. blade numbers, one a triangle; empty: one part
};

}  // namespace octoblisk
