// The part of a blade's surface that is ground.
#pragma once

#include <functional>
#include <vector>

#include "models/blade_contours.h"
#include "toolpath/path_steps.h"
#include "toolpath/surface_path.h"

namespace octoblisk::demos {

/// In mm.
double distanceBetween(const ContourPoint& a, const ContourPoint& b);

/// From pose to pose, in the greatest steps that the options allow: by distance or by turn, whichever is
/// more.
double stepsBetween(const ContourPoint& a, const ContourPoint& b, const SurfacePathOptions& options);

/// The part of a contour that is in the region. Lengths in mm.
class GroundLine {
 public:
  explicit GroundLine(std::vector<ContourPoint> points);

  double length() const { return lengths_.whole(); }

  /// At a part 0..1 of the length.
  ContourPoint at(double part) const;

  /// The points between two lengths, with those at the lengths.
  std::vector<ContourPoint> cut(double from, double to) const;

  /// Parts of the length at which to touch, from 0 to 1.
  std::vector<double> contacts(const SurfacePathOptions& options) const;

 private:
  std::vector<ContourPoint> points_;
  RunningSum lengths_;
};

/// Lines of equal height, from the tip inwards.
class GroundRegion {
 public:
  /// Keeps references to both. Throws std::invalid_argument where the margins leave nothing of it.
  GroundRegion(const BladeContours& blade, const SurfacePathOptions& options);

  double greatestLength() const;

  /// The steps of height from tip to root, each the greatest over the lines of a measure of two points.
  using Measure = std::function<double(const ContourPoint&, const ContourPoint&)>;
  RunningSum progress(const Measure& measure) const;

  /// The line where such a progress is this part of its whole.
  GroundLine lineAt(const RunningSum& progress, double part) const;

 private:
  GroundLine line(double part) const;
  GroundLine roundTheEdge(const BladeContour& contour) const;

  const BladeContours& blade_;
  const SurfacePathOptions& options_;
  std::vector<GroundLine> probes_;
};

}  // namespace octoblisk::demos
