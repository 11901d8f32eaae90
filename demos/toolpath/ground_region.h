// The region of a blade's surface to grind.
#pragma once

#include <functional>
#include <vector>

#include "models/blade_contours.h"
#include "models/contour_line.h"
#include "models/running_sum.h"
#include "toolpath/surface_path.h"

namespace octoblisk::demos {

/// The number of steps from one pose to the next, at the greatest step of the options in distance or in turn,
/// whichever needs more steps.
double stepsBetween(const ContourPoint& a, const ContourPoint& b, const SurfacePathOptions& options);

/// The contacts on a line, as fractions 0..1 of its length.
std::vector<double> contactsOn(const ContourLine& line, const SurfacePathOptions& options);

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
  ContourLine lineAt(const RunningSum& progress, double part) const;

 private:
  ContourLine line(double part) const;

  const BladeContours& blade_;
  const SurfacePathOptions& options_;
  std::vector<ContourLine> probes_;
};

}  // namespace octoblisk::demos
