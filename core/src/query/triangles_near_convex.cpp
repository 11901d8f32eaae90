#include "octoblisk/triangles_near_convex.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/triangles_near_convex.cpp"
#include <hwy/foreach_target.h>

#include "query/convex_cull-inl.h"
#include "query/leaf_triangles-inl.h"
#include "query/point_cull-inl.h"
#include "query/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

bool trianglesNear(const Tree& tree, std::span<const Vec3> points, const Aabb& bounds,
                   const Pose& convex_in_tree, double reach,
                   FunctionRef<bool(std::uint32_t triangle)> visit) {
  const LocalBox local(tree, convex_in_tree * obbOf(bounds));
  const float limit = local.limit(reach);
  const auto walk = [&](const auto& gap, const auto& cull) HWY_ATTR {
    return forEachLeafWithin(tree, local, gap, limit, [&](Slot leaf) HWY_ATTR {
      return forEachNearInLeaf(tree, leaf, cull, reach, visit);
    });
  };
  constexpr double kSquared = 1e18;  // the squares of larger gaps overflow
  if (points.size() == 1 && local.size < kSquared)
    return walk(GapOfPoint(), PointCull(tree.origin(), points[0], convex_in_tree));
  return walk(WidestGap(), ConvexCull(tree.origin(), points, bounds, convex_in_tree));
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "geometry/core_points.h"

namespace octoblisk {

using namespace detail;

HWY_EXPORT(trianglesNear);

bool forEachTriangleNear(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_tree,
                         double reach, FunctionRef<bool(std::uint32_t triangle)> visit) {
  std::array<Vec3, 8> room;
  const std::span<const Vec3> points = corePoints(convex, room);
  return HWY_DYNAMIC_DISPATCH(trianglesNear)(treeOf(tree), points, boundsOf(points), convex_in_tree,
                                             reach + convex.radius(), visit);
}

}  // namespace octoblisk
#endif
