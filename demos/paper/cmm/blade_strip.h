// A strip of a blade between two radii, as a grid of sections with the areas of the paper's Table 5.
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

/// Lengths in mm. All values are assumed: the paper gives neither the limits of its areas nor the numbers of
/// sections and points that it measured.
struct BladeStripOptions {
  double span_from = 0.50;   ///< lowest section, as a fraction of the blade's height: root 0, tip 1
  double span_to = 0.90;     ///< highest section
  int sections = 5;          ///< measured, equally spaced; at least 2
  double row_spacing = 0.5;  ///< of the grid, at most
  double margin = 6.0;       ///< of the grid beyond the lowest and the highest section
  double edge_part = 0.08;   ///< fraction of a side's length that belongs to the edge at either end
  /// Fraction of a side's length that is not measured around a border between areas.
  double border_part = 0.02;
  int points_per_area = 20;  ///< measured per section, at most
};

/// Stations run from the leading edge over the convex side to the trailing edge and back over the concave
/// side. A station keeps its fraction of its side's length from row to row. Stations are denser towards the
/// edges.
struct BladeStrip {
  /// The share of each area in a station, in the order of kBladeAreas; their sum is 1. Shares change smoothly
  /// across a border.
  using Shares = std::array<double, kBladeAreas.size()>;

  SectionGrid grid;
  std::size_t trailing_edge = 0;  ///< station; the leading edge is 0
  std::vector<Shares> shares{};   ///< per station
  std::vector<std::size_t> measured_rows{};
  std::array<std::vector<std::size_t>, kBladeAreas.size()> measured_stations{};  ///< wholly in their area

  /// The position of a station around the middle row's section, as a fraction 0..1.
  double loopFraction(std::size_t station) const;
};

/// Throws std::invalid_argument with a one-line message: what BladeCutter refuses, an option out of range, or
/// a strip that does not fit between root and tip.
BladeStrip makeBladeStrip(const TriangleMesh& blisk, const BladesFound& blades, int blade,
                          const BladeStripOptions& options = {});

}  // namespace octoblisk::demos
