// A line of points along the surface of a blade.
#pragma once

#include <vector>

#include "models/blade_contours.h"
#include "models/running_sum.h"

namespace octoblisk::demos {

/// Straight from each of its points to the next; there are at least two. Lengths in mm.
class ContourLine {
 public:
  explicit ContourLine(std::vector<ContourPoint> points);

  const std::vector<ContourPoint>& points() const { return points_; }
  double length() const { return lengths_.whole(); }

  /// At a fraction 0..1 of the length.
  ContourPoint at(double part) const;

  /// The section between two lengths.
  ContourLine cut(double from, double to) const;

 private:
  std::vector<ContourPoint> points_;
  RunningSum lengths_;
};

/// In mm.
double distanceBetween(const ContourPoint& a, const ContourPoint& b);

}  // namespace octoblisk::demos
