#include "query/ray_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/ray_walk.cpp"
#include <hwy/foreach_target.h>

#include "query/ray_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

void walk(const Tree& tree, const LocalRay& local, CandidateVisitor visitor, void* context) {
  const auto visit = [visitor, context](std::uint32_t triangle) { return visitor(context, triangle); };
  NoTally nothing;
  RayDescent(tree, local, visit, nothing).run();
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk::detail {

HWY_EXPORT(walk);

void walkRay(const Tree& tree, const Ray& ray, double rounding, CandidateVisitor visitor, void* context) {
  const std::optional<LocalRay> local = clipped(tree, ray, rounding);
  if (local) HWY_DYNAMIC_DISPATCH(walk)(tree, *local, visitor, context);
}

}  // namespace octoblisk::detail
#endif
