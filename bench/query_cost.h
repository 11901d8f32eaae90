// What a query looks at on its way to the answer: the work, beside which its time can be judged.
#pragma once

#include <cstddef>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/raycast.h"

namespace octoblisk::bench {

struct QueryCost {
  std::size_t box_tests = 0;       ///< of up to eight boxes against one, or against a ray
  std::size_t leaf_pairs = 0;      ///< whose boxes may be near enough; of a ray: leaves entered
  std::size_t triangle_tests = 0;  ///< of one triangle, or a ray, against up to eight
  std::size_t exact_tests = 0;     ///< of two triangles, or a ray and one, in double precision

  void boxTest() { ++box_tests; }
  void leafPair() { ++leaf_pairs; }
  void triangleTest() { ++triangle_tests; }
  void exactTest() { ++exact_tests; }

  /// About how many bytes these tests read, those read again counted again.
  std::size_t bytes(const ClusteredOctree& a, const ClusteredOctree& b) const;
  /// The same of a ray's.
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
