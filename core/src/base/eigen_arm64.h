// Makes Eigen round on ARM64 as it does on x86-64. The build includes this header before all others.
#pragma once

// Products and sums are rounded separately.
#pragma push_macro("__ARM_FEATURE_FMA")
#undef __ARM_FEATURE_FMA
#include <Eigen/Core>
#pragma pop_macro("__ARM_FEATURE_FMA")

namespace Eigen::internal {

/// Eigen never adds floats in pairs, which would change the order of sums over three floats.
template <int Size>
struct find_best_packet_helper<Size, Packet4f, false> {
  using type = Packet4f;
};

}  // namespace Eigen::internal
