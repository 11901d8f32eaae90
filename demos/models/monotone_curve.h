// A smooth curve through given points that never overshoots.
#pragma once

#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// A piecewise cubic Hermite curve with the monotone slopes of Fritsch and Butland (SIAM J. Sci. Stat.
/// Comput. 5, 1984): each coordinate rises exactly where its points rise, so a curve through them neither
/// overshoots nor folds back. It passes through every point exactly, and is straight through straight data.
class MonotoneCurve {
 public:
  enum class Ends { open, closed };  ///< closed: the last point repeats the first, and the slopes join

  /// Knots are strictly increasing, one per point, at least two (three if closed). Throws
  /// std::invalid_argument otherwise.
  MonotoneCurve(std::vector<double> knots, std::vector<Vec3> points, Ends ends = Ends::open);

  /// The point at a parameter; outside the knots the curve is straight, with its end slope.
  Vec3 at(double parameter) const;

 private:
  std::vector<double> knots_;
  std::vector<Vec3> points_;
  std::vector<Vec3> slopes_;  ///< d point / d parameter at each knot
};

}  // namespace octoblisk::demos
