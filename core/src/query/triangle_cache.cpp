#include "octoblisk/triangle_cache.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/triangle_cache.cpp"
#include <hwy/foreach_target.h>

#include "query/convex_cull-inl.h"
#include "query/point_cull-inl.h"
#include "query/triangle_bundle.h"
#include "simd/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

void sift(std::span<const TriangleBundle> bundles, const Vec3& origin, std::span<const Vec3> core,
          const Aabb& bounds, const Pose& convex_in_tree, double reach, std::vector<std::uint32_t>& found) {
  const auto siftBy = [&](const auto& cull) HWY_ATTR {
    for (const TriangleBundle& bundle : bundles) {
      for (const std::uint32_t i : Lanes(cull.near(bundle.box, bundle.corners.rows, bundle.count, reach))) {
        found.push_back(bundle.triangles[i]);
      }
    }
  };
  if (core.size() == 1) return siftBy(PointCull(origin, core[0], convex_in_tree));
  siftBy(ConvexCull(origin, core, bounds, convex_in_tree));
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "geometry/core_points.h"
#include "octoblisk/triangles_near_convex.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

HWY_EXPORT(sift);

void fill(TriangleBundle& bundle, const Tree& tree, std::span<const std::uint32_t> triangles,
          const Vec3& center) {
  bundle.count = static_cast<std::uint32_t>(triangles.size());
  std::ranges::copy(triangles, bundle.triangles.begin());
  std::ranges::fill(bundle.corners.rows, 0.0f);
  bundle.box = {};
  bundle.box.center = (center - tree.origin()).cast<float>();
  writeLeafVertices(tree.mesh(), triangles, bundle.box, tree.origin(), bundle.corners.rows);
  float largest = 0.0f;
  for (const float coordinate : bundle.corners.rows) largest = std::max(largest, std::abs(coordinate));
  bundle.box.half_extents.setConstant(largest);
}

}  // namespace

TriangleCache::TriangleCache() = default;
TriangleCache::TriangleCache(TriangleCache&&) noexcept = default;
TriangleCache& TriangleCache::operator=(TriangleCache&&) noexcept = default;
TriangleCache::~TriangleCache() = default;

/// An upper bound of how far points of the core have moved.
double TriangleCache::displacementBound(const Pose& pose, const Pose& from) const {
  const Vec3 center = bounds_.center();
  return (pose * center - from * center).norm() +
         (pose.rotation - from.rotation).norm() * bounds_.halfExtents().norm();
}

/// How far to search beyond the requested reach: the distance of a few steps. 0 for a body that is fast or
/// new.
double TriangleCache::reserveFor(const Pose& convex_in_tree, double radius) const {
  constexpr double kSteps = 8.0, kLeast = 1.0 / 32.0, kMax = 1.0 / 4.0;
  const double size = bounds_.halfExtents().norm() + radius;
  const double step = last_at_ ? displacementBound(convex_in_tree, *last_at_) : size;
  return step < 0.5 * kMax * size ? std::clamp(kSteps * step, kLeast * size, kMax * size) : 0.0;
}

/// Finds the triangles within the reach plus the reserve. Keeps them if there is a reserve.
void TriangleCache::gather(const ClusteredOctree& tree, const Convex& convex, std::span<const Vec3> core,
                           const Pose& convex_in_tree, double reach, double reserve) {
  found_.clear();
  found_.reserve(4 * kLanes);
  forEachTriangleNear(tree, convex, convex_in_tree, reach + reserve, [this](std::uint32_t triangle) {
    found_.push_back(triangle);
    return false;
  });
  kept_reach_ = kNothing;
  if (reserve == 0.0) return;
  core_.assign(core.begin(), core.end());
  kept_.resize((found_.size() + kLanes - 1) / kLanes);
  for (std::size_t b = 0; b < kept_.size(); ++b) {
    const std::size_t begin = b * kLanes, count = std::min<std::size_t>(kLanes, found_.size() - begin);
    fill(kept_[b], treeOf(tree), std::span(found_).subspan(begin, count), convex_in_tree * bounds_.center());
  }
  kept_reach_ = reach + reserve + convex.radius();
  kept_at_ = convex_in_tree;
}

std::span<const std::uint32_t> TriangleCache::find(const ClusteredOctree& tree, const Convex& convex,
                                                   const Pose& convex_in_tree, double reach) {
  std::array<Vec3, 8> room;
  const std::span<const Vec3> points = corePoints(convex, room);
  const Aabb bounds = boundsOf(points);
  if (tree_ != &tree || bounds.min != bounds_.min || bounds.max != bounds_.max) forget();
  tree_ = &tree;
  bounds_ = bounds;
  const double of_core = reach + convex.radius();
  const auto areKept = [&] {
    if (kept_reach_ == kNothing || !std::ranges::equal(core_, points)) return false;
    const double rounding = kDoubleRounding * (kept_at_.translation.norm() + bounds_.halfExtents().norm());
    return of_core + displacementBound(convex_in_tree, kept_at_) + rounding <= kept_reach_;
  };
  if (!areKept()) {
    const double reserve = reserveFor(convex_in_tree, convex.radius());
    gather(tree, convex, points, convex_in_tree, reach, reserve);
  }
  last_at_ = convex_in_tree;
  if (kept_reach_ == kNothing) return found_;
  found_.clear();
  const auto siftAll = HWY_DYNAMIC_DISPATCH(sift);
  siftAll(kept_, treeOf(tree).origin(), points, bounds_, convex_in_tree, of_core, found_);
  return found_;
}

}  // namespace octoblisk
#endif
