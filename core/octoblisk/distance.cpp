#include "octoblisk/distance.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "octoblisk/distance.cpp"
#include <hwy/foreach_target.h>

#include "octoblisk/nearest.h"
#include "octoblisk/traversal.h"
#include "octoblisk/triangle_distance.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::HWY_NAMESPACE {

void searchPairs(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, Nearest& nearest) {
  const LocalPose pose(a, b, b_in_a);
  nearest.setSize(pose.size);
  const auto bound = [](const Box8& boxes, const BoxF& box)
                         HWY_ATTR { return squaredDistanceBound(boxes, box); };
  const auto limit = [&] { return nearest.squaredLimit(); };
  walkPairs(a, b, pose, bound, limit, [&](Slot slot_a, Slot slot_b) HWY_ATTR {
    const LeafPair leaves(a, b, pose, slot_a, slot_b);
    const TriangleLanes triangles_of_b(leaves);
    const NearTriangles near(leaves);
    for (std::uint32_t i = 0; i < leaves.countA(); ++i) {
      unsigned left = near.boundsWithin(i, nearest.bound());
      if (left == 0) continue;
      const auto verdicts = triangles_of_b.meet(i);
      float distance[kLanes];
      near.distances(i).store(distance);
      for (; left != 0; left &= left - 1) {
        const auto j = static_cast<std::uint32_t>(std::countr_zero(left));
        const TrianglePair pair{leaves.triangleA(i), leaves.triangleB(j)};
        const bool may_meet = ((verdicts.meet | verdicts.open) >> j & 1u) != 0;
        if (may_meet ? nearest.offer(pair, true) : nearest.consider(pair, distance[j], near.rounding()))
          return true;
      }
    }
    return false;
  });
}

}  // namespace octoblisk::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk {

HWY_EXPORT(searchPairs);

Clearance distance(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                   const DistanceOptions& options) {
  Nearest nearest(a.mesh(), b.mesh(), b_in_a, options);
  const auto within = [](std::uint32_t triangle, const ClusteredOctree& tree) {
    return triangle < tree.mesh().triangleCount();
  };
  const bool hinted = within(options.hint.a, a) && within(options.hint.b, b);
  if (!hinted || !nearest.offer(options.hint, true)) HWY_DYNAMIC_DISPATCH(searchPairs)(a, b, b_in_a, nearest);
  return nearest.settled();
}

}  // namespace octoblisk
#endif
