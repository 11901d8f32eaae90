// The meridian of a surface of revolution about Z.
#pragma once

#include <filesystem>
#include <vector>

namespace octoblisk::demos {

/// The radius of a surface of revolution over z (mm): straight between its points, constant beyond them.
class RadiusProfile {
 public:
  struct Point {
    double z = 0.0;       ///< mm
    double radius = 0.0;  ///< mm, positive
  };

  /// At least two points, z strictly increasing, radii positive. Throws std::invalid_argument naming the
  /// first invalid point, counted from 1.
  explicit RadiusProfile(std::vector<Point> points);

  double radiusAt(double z) const;
  double zMin() const { return points_.front().z; }
  double zMax() const { return points_.back().z; }
  double minRadius() const;
  const std::vector<Point>& points() const { return points_; }

 private:
  std::vector<Point> points_;
};

/// A cylinder from z = -half_length to +half_length (mm). Throws std::invalid_argument for a size not above
/// 0.
RadiusProfile cylinderProfile(double radius, double half_length);

/// Reads a hub profile: CSV with the header `z,r`, mm, at least two points, z strictly increasing, r
/// positive, neither beyond kMaxLength. Throws std::runtime_error naming the file and line.
RadiusProfile readHubProfile(const std::filesystem::path& file);

}  // namespace octoblisk::demos
