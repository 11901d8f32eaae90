// Lets the library use some of Highway's instruction sets alone.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <vector>

namespace octoblisk::testing {

/// The instruction sets that the library is compiled for and the machine has, the best first. The last is
/// what every processor has: in GCC 12 Highway's scalar one, in Clang its emulation of vectors.
inline std::vector<std::int64_t> compiledTargets() {
  std::vector<std::int64_t> targets;
  for (std::int64_t left = HWY_TARGETS & (hwy::SupportedTargets() | HWY_STATIC_TARGET); left != 0;) {
    targets.push_back(left & -left);
    left &= left - 1;
  }
  return targets;
}

/// As long as it lives; the one that the program is compiled for is always among them.
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
