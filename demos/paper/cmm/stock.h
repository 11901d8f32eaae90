// The milled blade before grinding: its nominal surface and an error along the normal at each point.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "paper/cmm/blade_strip.h"
#include "paper/cmm/statistics_map.h"

namespace octoblisk::demos {

/// In the order of kBladeAreas, mm.
using AreaStatistics = std::array<ErrorStatistics, kBladeAreas.size()>;

/// Table 5 of the paper, before grinding.
inline constexpr AreaStatistics kPaperBefore = {{{0.0197, 0.0282, 0.0238, 0.0028},
                                                 {0.0188, 0.0271, 0.0234, 0.0024},
                                                 {0.0200, 0.0290, 0.0251, 0.0023},
                                                 {0.0191, 0.0260, 0.0228, 0.0021}}};

/// The correlation lengths (mm) are assumed, because the paper gives none.
struct StockOptions {
  AreaStatistics statistics = kPaperBefore;  ///< per area
  double correlation_along = 8.0;
  double correlation_up = 15.0;
  std::uint64_t seed = 1;
};

/// The error of each point of the strip's grid (mm, positive outwards).
///
/// One SmoothField covers the blade. In each area a StatisticsMap turns its values into errors such that the
/// measured points of all measured sections together have exactly the requested statistics. Points in between
/// follow smoothly, within the least and the greatest error. Across the borders of areas, where nothing is
/// measured, the errors of both areas are blended by their shares.
///
/// Throws std::invalid_argument as StatisticsMap does, and for a length not above 0.
std::vector<double> makeStock(const BladeStrip& strip, const StockOptions& options = {});

/// The grid's indices of the measured points of an area, section by section.
std::vector<std::size_t> measuredPoints(const BladeStrip& strip, std::size_t area);

}  // namespace octoblisk::demos
