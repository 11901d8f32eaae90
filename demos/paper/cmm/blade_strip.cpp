#include "paper/cmm/blade_strip.h"

#include <algorithm>
#include <cmath>

#include "models/require.h"

namespace octoblisk::demos {
namespace {

void requireUsable(const BladeStripOptions& options) {
  require(options.sections >= 2, "there must be at least two measured sections");
  require(options.span_from >= 0.0 && options.span_from < options.span_to && options.span_to <= 1.0,
          "the fractions of the span must ascend from 0 to 1");
  require(options.row_spacing > 0.0 && options.margin > 0.0, "the row spacing and margin must be above 0 mm");
  require(options.border_part > 0.0 && options.edge_part > options.border_part &&
              options.edge_part + options.border_part < 0.5,
          "the fraction of a side at its edges must be above the borders' fraction and below a half");
  require(options.points_per_area >= 2, "there must be at least two measured points per area");
}

/// The stations of a side as fractions 0..1 of its length; the steps grow from the edges to the middle.
std::vector<double> partsOfSide() {
  constexpr double kFirst = 0.0015;
  constexpr double kGrowth = 1.12;
  constexpr double kGreatest = 0.011;
  std::vector<double> half = {0.0};
  for (double step = kFirst; half.back() < 0.5; step = std::min(kGreatest, kGrowth * step)) {
    half.push_back(half.back() + step);
  }
  std::vector<double> parts;
  for (const double part : half) parts.push_back(0.5 * part / half.back());
  for (std::size_t k = half.size() - 1; k > 0; --k) parts.push_back(1.0 - parts[k - 1]);
  return parts;
}

/// Appends the points at fractions of a side's length, except the last, which is the first of the next side.
void appendSide(const std::vector<SectionPoint>& side, const std::vector<double>& parts,
                std::vector<SectionPoint>& row) {
  std::vector<double> arc = {0.0};
  for (std::size_t k = 1; k < side.size(); ++k) {
    arc.push_back(arc.back() + (side[k].flat - side[k - 1].flat).norm());
  }
  std::size_t segment = 0;
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    const double wanted = parts[k] * arc.back();
    while (segment + 2 < side.size() && arc[segment + 1] <= wanted) ++segment;
    const double part = (wanted - arc[segment]) / (arc[segment + 1] - arc[segment]);
    const SectionPoint &from = side[segment], &to = side[segment + 1];
    row.push_back(
        {(1.0 - part) * from.position + part * to.position, (1.0 - part) * from.flat + part * to.flat});
  }
}

double smoothStep(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// For a station of a side, at a fraction of its length from the leading edge.
BladeStrip::Shares sharesAt(double part, bool convex, const BladeStripOptions& options) {
  const double low = options.edge_part - options.border_part;
  const double high = options.edge_part + options.border_part;
  const double leading = 1.0 - smoothStep(low, high, part);
  const double trailing = smoothStep(1.0 - high, 1.0 - low, part);
  const double middle = 1.0 - leading - trailing;
  return {leading, convex ? middle : 0.0, trailing, convex ? 0.0 : middle};
}

/// The stations that lie wholly in an area, in order along it.
std::vector<std::size_t> stationsOf(std::size_t area, const std::vector<BladeStrip::Shares>& shares) {
  std::vector<std::size_t> stations;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (shares[k][area] == 1.0) stations.push_back(k);
  }
  // Those of the leading edge begin on the concave side, at the end of the section.
  for (std::size_t k = 1; k < stations.size(); ++k) {
    if (stations[k] == stations[k - 1] + 1) continue;
    std::rotate(stations.begin(), stations.begin() + static_cast<std::ptrdiff_t>(k), stations.end());
    break;
  }
  return stations;
}

/// At most `most` of them, spread evenly over their length.
std::vector<std::size_t> spread(const std::vector<std::size_t>& stations, const SectionGrid& grid,
                                std::size_t row, int count) {
  std::vector<double> arc = {0.0};
  for (std::size_t k = 1; k < stations.size(); ++k) {
    arc.push_back(arc.back() + (grid.at(row, stations[k]).flat - grid.at(row, stations[k - 1]).flat).norm());
  }
  std::vector<std::size_t> chosen;
  for (int k = 0; k < count; ++k) {
    const double wanted = arc.back() * k / (count - 1);
    const auto after = std::lower_bound(arc.begin(), arc.end(), wanted);
    std::size_t nearest = static_cast<std::size_t>(std::min(after, arc.end() - 1) - arc.begin());
    if (nearest > 0 && wanted - arc[nearest - 1] < arc[nearest] - wanted) --nearest;
    if (chosen.empty() || chosen.back() != stations[nearest]) chosen.push_back(stations[nearest]);
  }
  return chosen;
}

/// The heights of the grid's rows, and the rows that are measured.
struct Rows {
  std::vector<double> heights;
  std::vector<std::size_t> measured;
};

Rows rowsOf(const BladesFound& blades, const BladeStripOptions& options) {
  const double from = std::lerp(blades.root_radius, blades.tip_radius, options.span_from);
  const double to = std::lerp(blades.root_radius, blades.tip_radius, options.span_to);
  const double between = (to - from) / (options.sections - 1);
  const int rows_between = static_cast<int>(std::ceil(between / options.row_spacing));
  const double spacing = between / rows_between;
  const int rows_beyond = static_cast<int>(std::ceil(options.margin / spacing));
  const int last = rows_between * (options.sections - 1) + rows_beyond;
  Rows rows;
  for (int k = -rows_beyond; k <= last; ++k) {
    if (k >= 0 && k <= last - rows_beyond && k % rows_between == 0) {
      rows.measured.push_back(rows.heights.size());
    }
    rows.heights.push_back(from + k * spacing);
  }
  require(rows.heights.front() > blades.root_radius && rows.heights.back() < blades.tip_radius,
          "the strip and its margin do not fit between the blade's root and tip");
  return rows;
}

}  // namespace

double BladeStrip::loopFraction(std::size_t station) const {
  const std::size_t middle = grid.rows() / 2;
  return grid.at(middle, station).arc / grid.length(middle);
}

BladeStrip makeBladeStrip(const TriangleMesh& blisk, const BladesFound& blades, int blade,
                          const BladeStripOptions& options) {
  requireUsable(options);
  const BladeCutter cutter(blisk, blades, blade);
  const Rows rows = rowsOf(blades, options);
  const bool forward_is_convex = convexIsForward(cutter.at(rows.heights[rows.heights.size() / 2]));

  const std::vector<double> parts = partsOfSide();
  std::vector<double> parts_back(parts.rbegin(), parts.rend());
  for (double& part : parts_back) part = 1.0 - part;
  std::vector<std::vector<SectionPoint>> points;
  for (const double height : rows.heights) {
    BladeSection section = cutter.at(height);
    const std::vector<SectionPoint>& convex = forward_is_convex ? section.forward : section.backward;
    std::vector<SectionPoint>& concave = forward_is_convex ? section.backward : section.forward;
    std::reverse(concave.begin(), concave.end());
    points.emplace_back();
    appendSide(convex, parts, points.back());
    appendSide(concave, parts_back, points.back());
  }

  BladeStrip strip{.grid = SectionGrid(rows.heights, points, true), .measured_rows = rows.measured};
  strip.trailing_edge = parts.size() - 1;
  for (std::size_t k = 0; k < strip.grid.stations(); ++k) {
    const bool convex = k <= strip.trailing_edge;
    const double part = convex ? parts[k] : parts[2 * strip.trailing_edge - k];
    strip.shares.push_back(sharesAt(part, convex, options));
  }
  for (std::size_t area = 0; area < kBladeAreas.size(); ++area) {
    strip.measured_stations[area] =
        spread(stationsOf(area, strip.shares), strip.grid, strip.grid.rows() / 2, options.points_per_area);
  }
  return strip;
}

}  // namespace octoblisk::demos
