// A surface as rows of points, one row per section.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "models/blade_section.h"

namespace octoblisk::demos {

/// Every row has the same number of stations. In a closed grid the last station's neighbour is the first.
/// Lengths in mm.
class SectionGrid {
 public:
  struct Point {
    Vec3 position = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  ///< unit, outwards
    Vec2 flat = Vec2::Zero();
    Vec2 flat_normal = Vec2::Zero();  ///< of the section, unit, outwards
    double arc = 0.0;                 ///< length of the section from its first station
    double width = 0.0;               ///< of the station's cell: half the distances to both neighbours
  };

  /// The rows' heights must ascend. In space, along × up must point to the left of the section in its plane,
  /// as z × e_r = e_theta does on a blade. Outwards means out of a closed section, and to the left of an open
  /// one. Throws std::invalid_argument: fewer than two rows or three stations, rows of different lengths,
  /// heights that do not ascend, neighbours at the same place.
  SectionGrid(std::vector<double> heights, const std::vector<std::vector<SectionPoint>>& rows, bool closed);

  std::size_t rows() const { return heights_.size(); }
  std::size_t stations() const { return stations_; }
  std::size_t size() const { return points_.size(); }
  bool closed() const { return closed_; }
  double height(std::size_t row) const { return heights_[row]; }

  /// The lower and upper end of a row's cell, halfway to the neighbouring rows; its own height if it has no
  /// neighbour there.
  double cellBottom(std::size_t row) const;
  double cellTop(std::size_t row) const;

  std::size_t index(std::size_t row, std::size_t station) const { return row * stations_ + station; }
  const Point& at(std::size_t row, std::size_t station) const { return points_[index(row, station)]; }
  const std::vector<Point>& points() const { return points_; }

  /// The length of a row's section, including the closing step if it is closed.
  double length(std::size_t row) const;

  /// The surface with its points displaced along their normals, oriented outward; one displacement per point.
  TriangleMesh displaced(std::span<const double> displacements) const;

 private:
  std::size_t next(std::size_t station) const;  ///< the station itself at an open end
  std::size_t last(std::size_t station) const;
  void measureSections();
  void findNormals();

  std::vector<double> heights_;
  std::size_t stations_ = 0;
  bool closed_;
  double outward_ = 1.0;  ///< -1 if outwards is to the section's right
  std::vector<Point> points_;
};

}  // namespace octoblisk::demos
