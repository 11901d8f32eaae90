#include "query/near_pairs.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/near_pairs.cpp"
#include <hwy/foreach_target.h>

#include "query/near_pair_collector.h"
#include "query/near_pair_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

void addNearPairs(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold,
                  NearPairCollector& near) {
  const auto reach = [&near] { return near.reach(); };
  forEachNearPair(a, b, b_in_a, threshold, reach, [&](const NearPair& pair) { near.add(pair); });
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk::detail {

namespace {
HWY_EXPORT(addNearPairs);
}

double nearPairs(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold, double surplus,
                 std::vector<NearPair>& near) {
  NearPairCollector collector(near, threshold, surplus);
  HWY_DYNAMIC_DISPATCH(addNearPairs)(a, b, b_in_a, threshold, collector);
  return collector.reach();
}

}  // namespace octoblisk::detail
#endif
