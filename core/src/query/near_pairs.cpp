#include "query/near_pairs.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/near_pairs.cpp"
#include <hwy/foreach_target.h>

#include "query/near_pair_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

void appendNearPairs(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold,
                     std::vector<NearPair>& near) {
  forEachNearPair(a, b, b_in_a, threshold, [&](const NearPair& pair) { near.push_back(pair); });
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk::detail {

namespace {
HWY_EXPORT(appendNearPairs);
}

void nearPairs(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold,
               std::vector<NearPair>& near) {
  near.clear();
  HWY_DYNAMIC_DISPATCH(appendNearPairs)(a, b, b_in_a, threshold, near);
}

}  // namespace octoblisk::detail
#endif
