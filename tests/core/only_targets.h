// Restricts the library to some of Highway's instruction sets.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <vector>

namespace octoblisk::testing {

/// The instruction sets that the library is compiled for and the machine supports, best first. The last one
/// runs on every processor: Highway's scalar target with GCC 12, its emulated vectors with Clang.
inline std::vector<std::int64_t> compiledTargets() {
  std::vector<std::int64_t> targets;
  for (std::int64_t left = HWY_TARGETS & (hwy::SupportedTargets() | HWY_STATIC_TARGET); left != 0;) {
    targets.push_back(left & -left);
    left &= left - 1;
  }
  return targets;
}

/// Restricts the targets while it exists. The target that the program is compiled for always stays allowed.
class OnlyTargets {
 public:
  explicit OnlyTargets(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets | HWY_STATIC_TARGET);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~OnlyTargets() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  OnlyTargets(const OnlyTargets&) = delete;
  OnlyTargets& operator=(const OnlyTargets&) = delete;
};

}  // namespace octoblisk::testing
