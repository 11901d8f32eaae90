// A strip of a blade, between two radii, as a grid of sections with the areas of the paper's Table 5.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "paper/cmm/section_grid.h"

namespace octoblisk::demos {

/// Table 5 and fig. 13: A leading edge, B convex, C trailing edge, D concave.
enum class BladeArea { leading_edge, convex, trailing_edge, concave };
inline constexpr std::array kBladeAreas = {BladeArea::leading_edge, BladeArea::convex,
                                           BladeArea::trailing_edge, BladeArea::concave};

/// "A", "B", "C", "D".
const char* letterOf(BladeArea area);

/// Lengths in mm. The paper does not say where its areas end, nor how many sections and points it measured:
/// all of these are assumed.
struct BladeStripOptions {
  double span_from = 0.50;    ///< parts of the blade's height, root 0 to tip 1: of the lowest section
  double span_to = 0.90;      ///< and of the highest
  int sections = 5;           ///< measured, equally spaced; at least 2
  double row_spacing = 0.5;   ///< of the grid, at most
  double margin = 6.0;        ///< of the grid beyond the lowest and the highest section
  double edge_part = 0.08;    ///< of a side's length that belongs to the edge at either end
  double border_part = 0.02;  ///< of a side's length about a border between areas where nothing is measured
  int points_per_area = 20;   ///< measured, of each section, at most
};

/// Stations go from the leading edge over the convex side to the trailing edge and back over the concave
/// side; a station keeps its part of its side's length from row to row. They are denser towards the edges.
struct BladeStrip {
  /// Which part each area has of a station, in the order of kBladeAreas; their sum is 1. Across a border they
  /// pass smoothly into each other.
  using Shares = std::array<double, kBladeAreas.size()>;

  SectionGrid grid;
  std::size_t trailing_edge = 0;  ///< station; the leading edge is 0
  std::vector<Shares> shares{};   ///< one a station
  std::vector<std::size_t> measured_rows{};
  std::array<std::vector<std::size_t>, kBladeAreas.size()> measured_stations{};  ///< wholly of their area

  /// The part of the way round the section at a station, 0..1, of the middle row.
  double partRound(std::size_t station) const;
};

/// Throws std::invalid_argument in one line: what BladeCutter refuses, an option out of its range, a strip
/// that does not fit between root and tip.
BladeStrip makeBladeStrip(const TriangleMesh& blisk, const BladesFound& blades, int blade,
                          const BladeStripOptions& options = {});

}  // namespace octoblisk::demos
