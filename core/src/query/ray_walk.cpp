#include "query/ray_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/ray_walk.cpp"
#include <hwy/foreach_target.h>

#include "query/ray_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

constexpr std::size_t kRaysInTurn = 8;  // measured: 4 and 16 are slower

void walk(const Tree& tree, const LocalRay& local, CandidateVisitor visit) {
  NoTally nothing;
  RayDescent(tree, local, visit, nothing).run();
}

/// The visitor of one of many rays.
struct VisitorOfRay {
  double operator()(std::uint32_t triangle) const { return visit(ray, triangle); }

  RayCandidateVisitor visit;
  std::size_t ray;
};

void walkInTurn(const Tree& tree, std::span<const Ray> rays, RayCandidateVisitor visit) {
  NoTally nothing;
  std::array<std::optional<RayDescent<VisitorOfRay, NoTally>>, kRaysInTurn> descents;
  std::size_t next = 0;
  const auto start = [&](auto& descent) {
    descent.reset();
    for (; !descent && next < rays.size(); ++next) {
      if (const std::optional<LocalRay> local = clipped(tree, rays[next]))
        descent.emplace(tree, *local, VisitorOfRay{visit, next}, nothing);
    }
    return descent.has_value();
  };
  std::size_t count = 0;
  for (auto& descent : descents) count += start(descent);
  while (count > 0) {
    for (auto& descent : descents) {
      if (!descent) continue;
      if (!descent->step() && !start(descent)) --count;
      if (descent) descent->prefetchNext();
    }
  }
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk::detail {

HWY_EXPORT(walk);
HWY_EXPORT(walkInTurn);

void forEachCandidate(const Tree& tree, const Ray& ray, double rounding, CandidateVisitor visit) {
  const std::optional<LocalRay> local = clipped(tree, ray, rounding);
  if (local) HWY_DYNAMIC_DISPATCH(walk)(tree, *local, visit);
}

void forEachCandidate(const Tree& tree, std::span<const Ray> rays, RayCandidateVisitor visit) {
  HWY_DYNAMIC_DISPATCH(walkInTurn)(tree, rays, visit);
}

}  // namespace octoblisk::detail
#endif
