// Table 5 of the paper: the error of each area of the blade before grinding, mm.
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

}  // namespace octoblisk::demos
