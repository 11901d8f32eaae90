// An index that stands for none.
#pragma once

#include <cstdint>

namespace octoblisk::detail {

inline constexpr std::uint32_t kNoIndex = 0xffffffffu;

}  // namespace octoblisk::detail
