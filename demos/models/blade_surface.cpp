#include "models/blade_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace octoblisk::demos {
namespace {

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

/// How far a blade may be extended beyond its first or last section, as a fraction of its span.
constexpr double kMaxExtension = 0.25;

Vec3 asVector(const CylindricalPoint& point) { return {point.z, point.radius, point.angle}; }
CylindricalPoint asPoint(const Vec3& vector) { return {vector[0], vector[1], vector[2]}; }

/// The angle, shifted by whole turns, nearest to another.
double nearestTurn(double angle, double other) {
  return angle - 2.0 * std::numbers::pi * std::round((angle - other) / (2.0 * std::numbers::pi));
}

/// A section as a smooth closed curve of (z, radius, angle) that starts and ends at its leading edge.
class SectionCurve {
 public:
  SectionCurve(const SectionLoop& loop, std::size_t number, double angle_nearby)
      : SectionCurve(unrolled(loop, number, angle_nearby), number) {}

  Vec3 at(BladeSide side, double fraction) const {
    const double trailing = trailing_knot_;
    return curve_.at(side == forward_first_ ? fraction * trailing
                                            : length_ - fraction * (length_ - trailing));
  }
  double leadingAngle() const { return curve_.at(0.0)[2]; }

 private:
  struct Unrolled {
    std::vector<double> knots;  ///< length along the loop
    std::vector<Vec3> points;
    std::size_t trailing = 0;
  };

  SectionCurve(Unrolled loop, std::size_t number)
      : length_(loop.knots.back()),
        trailing_knot_(loop.knots[loop.trailing]),
        curve_(std::move(loop.knots), std::move(loop.points), MonotoneCurve::Ends::closed) {
    const double first_side = curve_.at(0.5 * trailing_knot_)[2];
    const double second_side = curve_.at(0.5 * (trailing_knot_ + length_))[2];
    if (first_side == second_side) {
      throw std::invalid_argument("section " + std::to_string(number) + " has no thickness");
    }
    forward_first_ = first_side > second_side ? BladeSide::forward : BladeSide::backward;
  }

  static Unrolled unrolled(SectionLoop loop, std::size_t number, double angle_nearby) {
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() < 4) {
      throw std::invalid_argument("section " + std::to_string(number) +
                                  " has fewer than four distinct points");
    }
    const auto by_z = [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); };
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), by_z), loop.end());
    const auto trailing = std::max_element(loop.begin(), loop.end(), by_z);
    const auto sharesZ = [&](const Vec3& edge) {
      return std::count_if(loop.begin(), loop.end(), [&](const Vec3& p) { return p.z() == edge.z(); }) > 1;
    };
    if (sharesZ(loop.front()) || sharesZ(*trailing)) {
      throw std::invalid_argument("section " + std::to_string(number) +
                                  " has an edge perpendicular to the axis; exactly one point must have the "
                                  "least z and exactly one the greatest");
    }
    Unrolled result;
    result.trailing = static_cast<std::size_t>(trailing - loop.begin());
    double angle = angle_nearby;
    for (const Vec3& point : loop) {
      const double radius = std::hypot(point.x(), point.y());
      angle = nearestTurn(std::atan2(point.y(), point.x()), angle);
      result.knots.push_back(result.points.empty()
                                 ? 0.0
                                 : result.knots.back() + (point - loop[result.points.size() - 1]).norm());
      result.points.emplace_back(point.z(), radius, angle);
    }
    result.knots.push_back(result.knots.back() + (loop.front() - loop.back()).norm());
    result.points.push_back(result.points.front());
    return result;
  }

  double length_;
  double trailing_knot_;
  MonotoneCurve curve_;
  BladeSide forward_first_ = BladeSide::forward;  ///< the side that comes first along the curve
};

/// The position of each section in the span, 0..1, by the mean distance between sections in the meridian.
std::vector<double> spanPositions(const std::vector<SectionCurve>& sections) {
  std::vector<double> positions{0.0};
  for (std::size_t s = 1; s < sections.size(); ++s) {
    double distance = 0.0;
    constexpr int kProbes = 8;
    for (int probe = 0; probe <= kProbes; ++probe) {
      const double fraction = static_cast<double>(probe) / kProbes;
      for (const BladeSide side : {BladeSide::forward, BladeSide::backward}) {
        const Vec3 step = sections[s].at(side, fraction) - sections[s - 1].at(side, fraction);
        distance += std::hypot(step[0], step[1]);
      }
    }
    if (distance == 0.0) {
      throw std::invalid_argument("section " + std::to_string(s + 1) + " repeats the previous one");
    }
    positions.push_back(positions.back() + distance);
  }
  for (double& position : positions) position /= positions.back();
  return positions;
}

/// The height of a point over a surface of revolution.
double heightOver(const RadiusProfile& surface, const Vec3& point) {
  return point[1] - surface.radiusAt(point[0]);
}

/// The parameter between low and high at which a line from inside the surface crosses it.
double crossing(const MonotoneCurve& line, const RadiusProfile& surface, double low, double high) {
  for (int halving = 0; halving < 64; ++halving) {
    const double middle = 0.5 * (low + high);
    (heightOver(surface, line.at(middle)) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double hubCrossing(const MonotoneCurve& line, const RadiusProfile& hub) {
  if (!(heightOver(hub, line.at(1.0)) > 0.0)) {
    throw std::invalid_argument(
        "the blade's tip lies below the hub surface: correct the sections or the hub profile");
  }
  if (heightOver(hub, line.at(-kMaxExtension)) > 0.0) {
    throw std::invalid_argument("the blade's first section lies " +
                                std::to_string(heightOver(hub, line.at(0.0))) +
                                " mm outside the hub surface: add a section below the hub surface");
  }
  return crossing(line, hub, -kMaxExtension, 1.0);
}

double shroudCrossing(const MonotoneCurve& line, const RadiusProfile& shroud, double root) {
  if (heightOver(shroud, line.at(root)) >= 0.0 || heightOver(shroud, line.at(1.0 + kMaxExtension)) <= 0.0) {
    throw std::invalid_argument(
        "the blade does not reach the shroud's inner surface: add a section beyond it");
  }
  return crossing(line, shroud, root, 1.0 + kMaxExtension);
}

}  // namespace

Vec3 toCartesian(const CylindricalPoint& point) {
  return {point.radius * std::cos(point.angle), point.radius * std::sin(point.angle), point.z};
}

BladeGrid::BladeGrid(int chord_cells, int span_cells)
    : chord_cells_(chord_cells),
      span_cells_(span_cells),
      points_(2 * static_cast<std::size_t>(chord_cells + 1) * (span_cells + 1)) {}

BladeGrid sampleBlade(const BladeSections& sections, const RadiusProfile& hub, const RadiusProfile* shroud,
                      int chord_cells, int span_cells) {
  if (sections.loops.size() < 2) throw std::invalid_argument("a blade needs at least two sections");
  std::vector<SectionCurve> curves;
  for (const SectionLoop& loop : sections.loops) {
    curves.emplace_back(loop, curves.size() + 1, curves.empty() ? 0.0 : curves.back().leadingAngle());
  }
  const std::vector<double> positions = spanPositions(curves);

  BladeGrid grid(chord_cells, span_cells);
  const auto sampleLine = [&](BladeSide side, int station) {
    const double fraction = 0.5 * (1.0 - std::cos(std::numbers::pi * station / chord_cells));
    std::vector<Vec3> points;
    for (const SectionCurve& curve : curves) points.push_back(curve.at(side, fraction));
    const MonotoneCurve line(positions, std::move(points));
    const double root = hubCrossing(line, hub);
    const double tip = shroud ? shroudCrossing(line, *shroud, root) : 1.0;
    for (int row = 0; row <= span_cells; ++row) {
      CylindricalPoint& point = grid.at(side, row, station);
      point = asPoint(line.at(std::lerp(root, tip, static_cast<double>(row) / span_cells)));
      if (row == 0) point.radius = hub.radiusAt(point.z);
      if (row == span_cells && shroud) point.radius = shroud->radiusAt(point.z);
      if (row > 0 &&
          heightOver(hub, asVector(point)) <= heightOver(hub, asVector(grid.at(side, row - 1, station)))) {
        throw std::invalid_argument(
            "the blade does not rise from the hub to the tip near z = " + std::to_string(point.z) + " mm");
      }
    }
  };
  for (int station = 0; station <= chord_cells; ++station) {
    sampleLine(BladeSide::forward, station);
    const bool at_edge = station == 0 || station == chord_cells;
    if (!at_edge) sampleLine(BladeSide::backward, station);
    for (int row = 0; at_edge && row <= span_cells; ++row) {
      grid.at(BladeSide::backward, row, station) = grid.at(BladeSide::forward, row, station);
    }
  }
  return grid;
}

}  // namespace octoblisk::demos
