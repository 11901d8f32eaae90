#include "models/monotone_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace octoblisk::demos {
namespace {

/// The slope at a knot between two secants: their weighted harmonic mean, 0 at an extremum.
double innerSlope(double secant_before, double secant_after, double step_before, double step_after) {
  if (secant_before * secant_after <= 0.0) return 0.0;
  const double weight_before = 2.0 * step_after + step_before;
  const double weight_after = step_after + 2.0 * step_before;
  return (weight_before + weight_after) / (weight_before / secant_before + weight_after / secant_after);
}

/// The slope at an end: that of the parabola through three points, limited so that the curve stays monotone.
double endSlope(double secant, double next_secant, double step, double next_step) {
  const double slope = ((2.0 * step + next_step) * secant - step * next_secant) / (step + next_step);
  if (slope * secant <= 0.0) return 0.0;
  const bool turns = secant * next_secant <= 0.0;
  return turns && std::abs(slope) > 3.0 * std::abs(secant) ? 3.0 * secant : slope;
}

}  // namespace

MonotoneCurve::MonotoneCurve(std::vector<double> knots, std::vector<Vec3> points, Ends ends)
    : knots_(std::move(knots)), points_(std::move(points)), slopes_(points_.size(), Vec3::Zero()) {
  const std::size_t count = points_.size();
  if (count < (ends == Ends::closed ? 3u : 2u) || knots_.size() != count) {
    throw std::invalid_argument(
        "a curve needs one knot per point, and at least two points (three if closed)");
  }
  std::vector<double> steps;
  std::vector<Vec3> secants;
  for (std::size_t k = 0; k + 1 < count; ++k) {
    steps.push_back(knots_[k + 1] - knots_[k]);
    if (!(steps.back() > 0.0))
      throw std::invalid_argument("the knots of a curve must be strictly increasing");
    secants.push_back((points_[k + 1] - points_[k]) / steps.back());
  }
  const std::size_t last = count - 1;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 1; k < last; ++k) {
      slopes_[k][axis] = innerSlope(secants[k - 1][axis], secants[k][axis], steps[k - 1], steps[k]);
    }
    if (ends == Ends::closed) {
      slopes_[0][axis] = innerSlope(secants.back()[axis], secants[0][axis], steps.back(), steps[0]);
      slopes_[last][axis] = slopes_[0][axis];
    } else if (count == 2) {
      slopes_[0][axis] = slopes_[1][axis] = secants[0][axis];
    } else {
      slopes_[0][axis] = endSlope(secants[0][axis], secants[1][axis], steps[0], steps[1]);
      slopes_[last][axis] =
          endSlope(secants[last - 1][axis], secants[last - 2][axis], steps[last - 1], steps[last - 2]);
    }
  }
}

Vec3 MonotoneCurve::at(double parameter) const {
  if (parameter <= knots_.front()) return points_.front() + (parameter - knots_.front()) * slopes_.front();
  if (parameter >= knots_.back()) return points_.back() + (parameter - knots_.back()) * slopes_.back();
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), parameter);
  const auto k = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const double step = knots_[k + 1] - knots_[k];
  const double s = (parameter - knots_[k]) / step;  // 0..1 along this piece
  const double rest = 1.0 - s;
  return rest * rest * (1.0 + 2.0 * s) * points_[k] + s * s * (3.0 - 2.0 * s) * points_[k + 1] +
         step * s * rest * (rest * slopes_[k] - s * slopes_[k + 1]);
}

}  // namespace octoblisk::demos
