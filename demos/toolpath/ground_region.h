// The region of a blade's surface to grind.
#pragma once

#include <functional>
#include <vector>

#include "models/blade_contours.h"
#include "toolpath/path_steps.h"
#include "toolpath/surface_path.h"

namespace octoblisk::demos {

/// In mm.
double distanceBetween(const ContourPoint& a, const ContourPoint& b);

/// The number of steps from one pose to the next, at the greatest step of the options in distance or in turn,
/// whichever needs more steps.
double stepsBetween(const ContourPoint& a, const ContourPoint& b, const SurfacePathOptions& options);

/// The section of a contour inside the region. Lengths in mm.
class GroundLine {
 public:
  explicit GroundLine(std::vector<ContourPoint> points);

  double length() const { return lengths_.whole(); }

  /// At a fraction 0..1 of the length.
  ContourPoint at(double part) const;

  /// The points between two lengths, and the points at the two lengths.
  std::vector<ContourPoint> cut(double from, double to) const;

  /// The contacts, as fractions 0..1 of the length.
  std::vector<double> contacts(const SurfacePathOptions& options) const;

 private:
  std::vector<ContourPoint> points_;
  RunningSum lengths_;
};

/// Lines of equal height, from the tip inwards.
class GroundRegion {
 public:
  /// Keeps references to both. Throws std::invalid_argument if the margins leave nothing of the region.
  GroundRegion(const BladeContours& blade, const SurfacePathOptions& options);

  double greatestLength() const;

  /// A sum of steps in height from tip to root; each step is the greatest of a measure of two points over the
  /// lines.
  using Measure = std::function<double(const ContourPoint&, const ContourPoint&)>;
  RunningSum progress(const Measure& measure) const;

  /// The line at which a progress reaches this fraction of its total.
  GroundLine lineAt(const RunningSum& progress, double part) const;

 private:
  GroundLine line(double part) const;
  GroundLine roundTheEdge(const BladeContour& contour) const;

  const BladeContours& blade_;
  const SurfacePathOptions& options_;
  std::vector<GroundLine> probes_;
};

}  // namespace octoblisk::demos
