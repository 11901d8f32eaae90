#include "models/radius_profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "io/csv_table.h"
#include "models/length_limit.h"

namespace octoblisk::demos {

RadiusProfile::RadiusProfile(std::vector<Point> points) : points_(std::move(points)) {
  if (points_.size() < 2) throw std::invalid_argument("a radius profile needs at least two points");
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::string name = "point " + std::to_string(p + 1) + " of the radius profile";
    if (!std::isfinite(points_[p].z) || !std::isfinite(points_[p].radius) || points_[p].radius <= 0.0) {
      throw std::invalid_argument(name + " must have a finite z and a positive radius");
    }
    if (p > 0 && !(points_[p].z > points_[p - 1].z)) {
      throw std::invalid_argument(name + " must have a greater z than the previous point");
    }
  }
}

double RadiusProfile::radiusAt(double z) const {
  const auto after = std::upper_bound(points_.begin(), points_.end(), z,
                                      [](double value, const Point& point) { return value < point.z; });
  if (after == points_.begin()) return points_.front().radius;
  if (after == points_.end()) return points_.back().radius;
  const auto before = after - 1;
  return std::lerp(before->radius, after->radius, (z - before->z) / (after->z - before->z));
}

double RadiusProfile::minRadius() const {
  const auto by_radius = [](const Point& a, const Point& b) { return a.radius < b.radius; };
  return std::min_element(points_.begin(), points_.end(), by_radius)->radius;
}

RadiusProfile cylinderProfile(double radius, double half_length) {
  if (!(radius > 0.0)) throw std::invalid_argument("the hub radius must be above 0 mm");
  if (!(half_length > 0.0)) throw std::invalid_argument("the hub length must be above 0 mm");
  return RadiusProfile({{-half_length, radius}, {half_length, radius}});
}

RadiusProfile readHubProfile(const std::filesystem::path& file) {
  std::vector<RadiusProfile::Point> points;
  std::size_t last_line = 1;
  for (const CsvRow& row : readCsv(file, "z,r")) {
    const RadiusProfile::Point point{row.values[0], row.values[1]};
    last_line = row.line;
    if (point.radius <= 0.0)
      throw std::runtime_error(atLine(file, row.line, "the radius must be above 0 mm"));
    if (std::max(std::abs(point.z), point.radius) > kMaxLength) {
      throw std::runtime_error(atLine(file, row.line, "a length exceeds 100,000 mm"));
    }
    if (!points.empty() && point.z <= points.back().z) {
      throw std::runtime_error(atLine(file, row.line, "z must be greater than in the previous row"));
    }
    points.push_back(point);
  }
  if (points.size() < 2) {
    throw std::runtime_error(atLine(file, last_line, "a hub profile needs at least two points"));
  }
  return RadiusProfile(std::move(points));
}

}  // namespace octoblisk::demos
