// The work of a query: the tests it makes and the bytes it reads. The query's time can be judged against it.
#pragma once

#include <cstddef>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/raycast.h"

namespace octoblisk::bench {

struct QueryCost {
  std::size_t box_tests = 0;       ///< of up to eight boxes against one box or a ray
  std::size_t leaf_pairs = 0;      ///< pairs whose boxes may be near enough; for a ray: leaves entered
  std::size_t triangle_tests = 0;  ///< of up to eight triangle pairs, or of a ray and up to eight triangles
  std::size_t exact_tests = 0;     ///< of two triangles, or of a ray and a triangle, in double precision

  void boxTest() { ++box_tests; }
  void leafPair() { ++leaf_pairs; }
  void triangleTest() { ++triangle_tests; }
  void exactTest() { ++exact_tests; }

  /// The approximate number of bytes that these tests read. Repeated reads count again.
  std::size_t bytes(const ClusteredOctree& a, const ClusteredOctree& b) const;
  /// The same for a ray.
  std::size_t bytes(const ClusteredOctree& tree) const;
};

/// The cost of collide(a, b, b_in_a).
QueryCost costOfCollide(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a);

/// The cost of touchingPairs(a, b, b_in_a, ...).
QueryCost costOfTouchingPairs(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a);

/// The cost of distance(a, b, b_in_a).
QueryCost costOfDistance(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a);

/// The cost of closestHit(tree, ray).
QueryCost costOfClosestHit(const ClusteredOctree& tree, const Ray& ray);

}  // namespace octoblisk::bench
