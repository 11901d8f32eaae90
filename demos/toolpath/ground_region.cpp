#include "toolpath/ground_region.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "models/radians.h"
#include "models/require.h"
#include "toolpath/path_steps.h"

namespace octoblisk::demos {
namespace {

constexpr int kProbeRows = 121;  // rows of the region that are measured
constexpr int kProbeColumns = 17;

double turnBetween(const ContourPoint& a, const ContourPoint& b) {
  return std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
}

}  // namespace

double stepsBetween(const ContourPoint& a, const ContourPoint& b, const SurfacePathOptions& options) {
  return std::max(distanceBetween(a, b) / options.pose_step,
                  turnBetween(a, b) / radians(options.greatest_turn));
}

std::vector<double> contactsOn(const ContourLine& line, const SurfacePathOptions& options) {
  const std::vector<ContourPoint>& points = line.points();
  RunningSum effort;
  for (std::size_t k = 1; k < points.size(); ++k) {
    effort.add(stepsBetween(points[k - 1], points[k], options));
  }
  const int steps = stepsFor(effort.whole());
  std::vector<double> parts;
  for (int k = 0; k <= steps; ++k) {
    const double place = effort.placeOf(evenPart(k, steps + 1));
    const auto first = std::min(static_cast<std::size_t>(place), points.size() - 2);
    double length_here = 0.0;
    for (std::size_t j = 1; j <= first; ++j) length_here += distanceBetween(points[j - 1], points[j]);
    const double step = distanceBetween(points[first], points[first + 1]);
    parts.push_back((length_here + (place - static_cast<double>(first)) * step) / line.length());
  }
  return parts;
}

GroundRegion::GroundRegion(const BladeContours& blade, const SurfacePathOptions& options)
    : blade_(blade), options_(options) {
  for (int row = 0; row < kProbeRows; ++row) probes_.push_back(line(evenPart(row, kProbeRows)));
}

double GroundRegion::greatestLength() const {
  double greatest = 0.0;
  for (const ContourLine& probe : probes_) greatest = std::max(greatest, probe.length());
  return greatest;
}

RunningSum GroundRegion::progress(const Measure& measure) const {
  RunningSum result;
  for (std::size_t row = 1; row < probes_.size(); ++row) {
    double greatest = 0.0;
    for (int column = 0; column < kProbeColumns; ++column) {
      const double part = evenPart(column, kProbeColumns);
      greatest = std::max(greatest, measure(probes_[row - 1].at(part), probes_[row].at(part)));
    }
    result.add(greatest);
  }
  return result;
}

ContourLine GroundRegion::lineAt(const RunningSum& progress, double part) const {
  return line(progress.placeOf(part) / (kProbeRows - 1));
}

ContourLine GroundRegion::line(double part) const {
  const BladeContour contour = blade_.at(std::lerp(options_.height_to, options_.height_from, part));
  const ContourLine whole = regionLine(contour, options_.region, options_.edge_reach);
  if (isEdge(options_.region)) return whole;
  require(2.0 * options_.edge_margin < whole.length(),
          "--edge-margin is too large for the side, which is " + std::to_string(whole.length()) + " mm wide");
  return whole.cut(options_.edge_margin, whole.length() - options_.edge_margin);
}

}  // namespace octoblisk::demos
