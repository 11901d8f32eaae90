// Surfaces for the tests of the ground blade: grids of sections with closed forms.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "paper/cmm/section_grid.h"

namespace octoblisk::demos {

/// `rows` sections y(x) from x = -length/2 to length/2, a spacing apart, from height 0. Outwards is +y, which
/// is +z in space; up is +y in space.
inline SectionGrid openGrid(double length, int stations, double spacing, int rows,
                            const std::function<double(double)>& profile) {
  std::vector<double> heights;
  std::vector<std::vector<SectionPoint>> points;
  for (int row = 0; row < rows; ++row) {
    heights.push_back(row * spacing);
    points.emplace_back();
    for (int k = 0; k < stations; ++k) {
      const double x = length * (static_cast<double>(k) / (stations - 1) - 0.5);
      points.back().push_back({Vec3(x, heights.back(), profile(x)), Vec2(x, profile(x))});
    }
  }
  return SectionGrid(heights, points, false);
}

inline SectionGrid plate(double length, int stations, double spacing, int rows) {
  return openGrid(length, stations, spacing, rows, [](double) { return 0.0; });
}

/// The index of the station nearest to x in an open grid.
inline std::size_t stationAt(const SectionGrid& grid, double x) {
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < grid.stations(); ++k) {
    if (std::abs(grid.at(0, k).flat.x() - x) < std::abs(grid.at(0, nearest).flat.x() - x)) nearest = k;
  }
  return nearest;
}

}  // namespace octoblisk::demos
