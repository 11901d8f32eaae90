#include "plan/pass_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace octoblisk::demos {
namespace {

/// The grid as the lines that passes may follow.
class Lines {
 public:
  Lines(const SurfaceGrid& grid, bool along_columns) : grid_(grid), along_columns_(along_columns) {}

  std::size_t count() const { return along_columns_ ? grid_.columns : grid_.rows; }
  std::size_t length() const { return along_columns_ ? grid_.rows : grid_.columns; }
  std::size_t cell(std::size_t line, std::size_t k) const {
    return along_columns_ ? k * grid_.columns + line : line * grid_.columns + k;
  }
  const SurfacePoint& at(std::size_t line, std::size_t k) const { return grid_.points[cell(line, k)]; }

  /// The distance from a line to the next, in widths that a pass grinds; the greatest along the lines.
  double widthsToNext(std::size_t line, const PassWidth& width) const {
    double greatest = 0.0;
    for (std::size_t k = 0; k < length(); ++k) {
      const Vec3 step = at(line + 1, k).point - at(line, k).point;
      const double curvature = (at(line + 1, k).normal - at(line, k).normal).dot(step) / step.squaredNorm();
      greatest = std::max(greatest, step.norm() / groundWidth(curvature, width.belt_width, width.scallop));
    }
    return greatest;
  }

 private:
  const SurfaceGrid& grid_;
  bool along_columns_;
};

/// A pass along `middle` that grinds the lines first … end − 1.
struct Swath {
  std::size_t first, middle, end;
};

/// The first and the last place of each stretch of a swath that has wanted cells.
std::vector<std::pair<std::size_t, std::size_t>> stretchesOf(const Lines& lines, const Swath& swath,
                                                             const std::vector<bool>& wanted,
                                                             double longest_gap) {
  std::vector<std::pair<std::size_t, std::size_t>> stretches;
  for (std::size_t k = 0; k < lines.length(); ++k) {
    bool is_wanted = false;
    for (std::size_t line = swath.first; line < swath.end; ++line) is_wanted |= wanted[lines.cell(line, k)];
    if (!is_wanted) continue;
    const auto gap = [&] {
      return (lines.at(swath.middle, k).point - lines.at(swath.middle, stretches.back().second).point).norm();
    };
    if (stretches.empty() || gap() > longest_gap) stretches.emplace_back(k, k);
    stretches.back().second = k;
  }
  return stretches;
}

}  // namespace

double groundWidth(double curvature, double belt_width, double depth) {
  const double half = 0.5 * belt_width;
  const double reach = 2.0 * depth / std::abs(curvature);  // squared distance over which the depth falls to 0
  if (curvature > 0.0) return 2.0 * std::min(half, std::sqrt(reach));
  return reach >= half * half ? belt_width : half - std::sqrt(half * half - reach);
}

std::vector<PassLine> passLines(const SurfaceGrid& grid, const std::vector<bool>& wanted, bool towards_tip,
                                const PassWidth& width) {
  const Lines lines(grid, towards_tip);
  std::vector<double> place = {0.0};  // of each line, in widths
  for (std::size_t line = 0; line + 1 < lines.count(); ++line) {
    place.push_back(place.back() + lines.widthsToNext(line, width));
  }
  std::vector<PassLine> passes;
  bool goes_back = false;
  for (std::size_t first = 0, end = 0; first < lines.count(); first = end) {
    end = first + 1;
    bool any_wanted = false;
    for (std::size_t k = 0; k < lines.length(); ++k) any_wanted |= wanted[lines.cell(first, k)];
    if (!any_wanted) continue;
    Swath swath{first, first, end};
    while (end < lines.count() && place[end] - place[first] <= width.part) ++end;
    while (swath.middle + 1 < end && place[swath.middle + 1] - place[first] <= 0.5 * width.part)
      ++swath.middle;
    swath.end = end;
    auto stretches = stretchesOf(lines, swath, wanted, width.belt_width);
    if (goes_back) std::ranges::reverse(stretches);
    for (const auto& [from, to] : stretches) {
      PassLine& pass = passes.emplace_back();
      for (std::size_t k = from; k <= to; ++k) pass.push_back(lines.cell(swath.middle, k));
      if (goes_back) std::ranges::reverse(pass);
    }
    goes_back = !goes_back;
  }
  return passes;
}

}  // namespace octoblisk::demos
