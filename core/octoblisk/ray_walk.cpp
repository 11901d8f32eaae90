#include "octoblisk/ray_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "octoblisk/ray_walk.cpp"
#include <hwy/foreach_target.h>

#include "octoblisk/ray_descent.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::HWY_NAMESPACE {

void walk(const ClusteredOctree& tree, const Ray& ray, const LocalRay& local, CrossingVisitor visitor,
          void* context) {
  const auto visit = [visitor, context](const RayCrossing& crossing) { return visitor(context, crossing); };
  NoTally nothing;
  RayDescent(tree, ray, local, visit, nothing).run();
}

}  // namespace octoblisk::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk {

HWY_EXPORT(walk);

void walkRay(const ClusteredOctree& tree, const Ray& ray, CrossingVisitor visitor, void* context) {
  const std::optional<LocalRay> local = clipped(tree, ray);
  if (local) HWY_DYNAMIC_DISPATCH(walk)(tree, ray, *local, visitor, context);
}

}  // namespace octoblisk
#endif
