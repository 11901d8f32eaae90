#include "query/ray_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/ray_walk.cpp"
#include <hwy/foreach_target.h>

#include "query/ray_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

void walk(const Tree& tree, const Ray& ray, const LocalRay& local, CrossingVisitor visitor, void* context) {
  const auto visit = [visitor, context](const RayCrossing& crossing) { return visitor(context, crossing); };
  NoTally nothing;
  RayDescent(tree, ray, local, visit, nothing).run();
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk::detail {

HWY_EXPORT(walk);

void walkRay(const Tree& tree, const Ray& ray, CrossingVisitor visitor, void* context) {
  const std::optional<LocalRay> local = clipped(tree, ray);
  if (local) HWY_DYNAMIC_DISPATCH(walk)(tree, ray, *local, visitor, context);
}

}  // namespace octoblisk::detail
#endif
