// A grid of points over one side of a blade.
#pragma once

#include <cstddef>
#include <vector>

#include "models/blade_contours.h"
#include "models/blade_surface.h"

namespace octoblisk::demos {

/// Cells of equal steps over the height (root 0, tip 1) and over the chord (leading edge 0, trailing edge 1),
/// which is measured along the contours of equal height. They are ordered row by row, the lowest first.
class SideGrid {
 public:
  /// Throws as BladeContours::at; rows and columns must be above 0.
  SideGrid(const BladeContours& contours, BladeSide side, int rows, int columns);

  BladeSide side() const { return side_; }
  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  std::size_t size() const { return middles_.size(); }

  double heightOf(std::size_t cell) const { return middle(cell / columns_, rows_); }
  double chordOf(std::size_t cell) const { return middle(cell % columns_, columns_); }
  const ContourPoint& middleOf(std::size_t cell) const { return middles_[cell]; }
  /// The cells' corners: in each row one more than there are cells, and one more row.
  const std::vector<Vec3>& corners() const { return corners_; }
  double areaOf(std::size_t cell) const { return areas_[cell]; }

  /// Two triangles per cell, in the order of the cells, facing outward like the blade.
  TriangleMesh mesh() const;

 private:
  static double middle(std::size_t index, std::size_t count) {
    return (static_cast<double>(index) + 0.5) / static_cast<double>(count);
  }
  std::size_t corner(std::size_t row, std::size_t column) const { return row * (columns_ + 1) + column; }

  BladeSide side_;
  std::size_t rows_, columns_;
  std::vector<Vec3> corners_;
  std::vector<ContourPoint> middles_;
  std::vector<double> areas_;  // mm²
};

}  // namespace octoblisk::demos
