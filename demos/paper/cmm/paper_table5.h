// Table 5 of the paper: the error of each area of the blade before and after grinding, mm.
#pragma once

#include <array>

#include "paper/cmm/blade_strip.h"
#include "paper/cmm/error_statistics.h"

namespace octoblisk::demos {

/// In the order of kBladeAreas.
using AreaStatistics = std::array<ErrorStatistics, kBladeAreas.size()>;

inline constexpr AreaStatistics kPaperBefore = {{{0.0197, 0.0282, 0.0238, 0.0028},
                                                 {0.0188, 0.0271, 0.0234, 0.0024},
                                                 {0.0200, 0.0290, 0.0251, 0.0023},
                                                 {0.0191, 0.0260, 0.0228, 0.0021}}};

/// Only for comparison; no computation uses it.
inline constexpr AreaStatistics kPaperAfter = {{{0.0137, 0.0235, 0.0183, 0.0031},
                                                {0.0116, 0.0199, 0.0154, 0.0025},
                                                {0.0134, 0.0223, 0.0181, 0.0029},
                                                {0.0133, 0.0197, 0.0168, 0.0021}}};

}  // namespace octoblisk::demos
