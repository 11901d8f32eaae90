#include "models/contour_line.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace octoblisk::demos {

double distanceBetween(const ContourPoint& a, const ContourPoint& b) {
  return (b.position - a.position).norm();
}

ContourLine::ContourLine(std::vector<ContourPoint> points) : points_(std::move(points)) {
  for (std::size_t k = 1; k < points_.size(); ++k) lengths_.add(distanceBetween(points_[k - 1], points_[k]));
}

ContourPoint ContourLine::at(double part) const {
  const double place = lengths_.placeOf(part);
  const auto first = std::min(static_cast<std::size_t>(place), points_.size() - 2);
  const ContourPoint &a = points_[first], &b = points_[first + 1];
  const double within = place - static_cast<double>(first);
  return {a.position + within * (b.position - a.position),
          (a.normal + within * (b.normal - a.normal)).normalized()};
}

ContourLine ContourLine::cut(double from, double to) const {
  std::vector<ContourPoint> section = {at(from / length())};
  double length_here = 0.0;
  for (std::size_t k = 1; k + 1 < points_.size(); ++k) {
    length_here += distanceBetween(points_[k - 1], points_[k]);
    if (length_here > from && length_here < to) section.push_back(points_[k]);
  }
  section.push_back(at(to / length()));
  return ContourLine(std::move(section));
}

}  // namespace octoblisk::demos
