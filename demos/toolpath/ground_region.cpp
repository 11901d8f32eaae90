#include "toolpath/ground_region.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "models/radians.h"
#include "models/require.h"

namespace octoblisk::demos {
namespace {

constexpr int kProbeRows = 121;  // rows of the region that are measured
constexpr int kProbeColumns = 17;

double turnBetween(const ContourPoint& a, const ContourPoint& b) {
  return std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
}

ContourPoint between(const ContourPoint& a, const ContourPoint& b, double part) {
  return {a.position + part * (b.position - a.position),
          (a.normal + part * (b.normal - a.normal)).normalized()};
}

}  // namespace

double distanceBetween(const ContourPoint& a, const ContourPoint& b) {
  return (b.position - a.position).norm();
}

double stepsBetween(const ContourPoint& a, const ContourPoint& b, const SurfacePathOptions& options) {
  return std::max(distanceBetween(a, b) / options.pose_step,
                  turnBetween(a, b) / radians(options.greatest_turn));
}

GroundLine::GroundLine(std::vector<ContourPoint> points) : points_(std::move(points)) {
  for (std::size_t k = 1; k < points_.size(); ++k) lengths_.add(distanceBetween(points_[k - 1], points_[k]));
}

ContourPoint GroundLine::at(double part) const {
  const double place = lengths_.placeOf(part);
  const auto first = std::min(static_cast<std::size_t>(place), points_.size() - 2);
  return between(points_[first], points_[first + 1], place - static_cast<double>(first));
}

std::vector<ContourPoint> GroundLine::cut(double from, double to) const {
  std::vector<ContourPoint> result = {at(from / length())};
  double length_here = 0.0;
  for (std::size_t k = 1; k + 1 < points_.size(); ++k) {
    length_here += distanceBetween(points_[k - 1], points_[k]);
    if (length_here > from && length_here < to) result.push_back(points_[k]);
  }
  result.push_back(at(to / length()));
  return result;
}

std::vector<double> GroundLine::contacts(const SurfacePathOptions& options) const {
  RunningSum effort;
  for (std::size_t k = 1; k < points_.size(); ++k) {
    effort.add(stepsBetween(points_[k - 1], points_[k], options));
  }
  const int steps = stepsFor(effort.whole());
  std::vector<double> parts;
  for (int k = 0; k <= steps; ++k) {
    const double place = effort.placeOf(evenPart(k, steps + 1));
    const auto first = std::min(static_cast<std::size_t>(place), points_.size() - 2);
    double length_here = 0.0;
    for (std::size_t j = 1; j <= first; ++j) length_here += distanceBetween(points_[j - 1], points_[j]);
    const double step = distanceBetween(points_[first], points_[first + 1]);
    parts.push_back((length_here + (place - static_cast<double>(first)) * step) / length());
  }
  return parts;
}

GroundRegion::GroundRegion(const BladeContours& blade, const SurfacePathOptions& options)
    : blade_(blade), options_(options) {
  for (int row = 0; row < kProbeRows; ++row) probes_.push_back(line(evenPart(row, kProbeRows)));
}

double GroundRegion::greatestLength() const {
  double greatest = 0.0;
  for (const GroundLine& probe : probes_) greatest = std::max(greatest, probe.length());
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

GroundLine GroundRegion::lineAt(const RunningSum& progress, double part) const {
  return line(progress.placeOf(part) / (kProbeRows - 1));
}

GroundLine GroundRegion::line(double part) const {
  const BladeContour contour = blade_.at(std::lerp(options_.height_to, options_.height_from, part));
  if (options_.region == PathRegion::leading_edge) return roundTheEdge(contour);
  const GroundLine whole(options_.region == PathRegion::forward ? contour.forward : contour.backward);
  require(2.0 * options_.edge_margin < whole.length(),
          "--edge-margin is too large for the side, which is " + std::to_string(whole.length()) + " mm wide");
  return GroundLine(whole.cut(options_.edge_margin, whole.length() - options_.edge_margin));
}

GroundLine GroundRegion::roundTheEdge(const BladeContour& contour) const {
  const auto fromEdge = [&](const std::vector<ContourPoint>& half) {
    const GroundLine whole(half);
    require(options_.edge_reach <= whole.length(), "--edge-reach is too large for the side, which is " +
                                                       std::to_string(whole.length()) + " mm wide");
    return whole.cut(0.0, options_.edge_reach);
  };
  std::vector<ContourPoint> points = fromEdge(contour.backward);
  std::reverse(points.begin(), points.end());
  const std::vector<ContourPoint> forward = fromEdge(contour.forward);
  points.insert(points.end(), forward.begin() + 1, forward.end());
  return GroundLine(std::move(points));
}

}  // namespace octoblisk::demos
