// A grid of points over a side or an edge of a blade.
#pragma once

#include <cstddef>
#include <vector>

#include "models/blade_contours.h"
#include "models/blade_region.h"

namespace octoblisk::demos {

/// Cells of equal steps over the height (root 0, tip 1) and along the region's lines of equal height
/// (blade_region.h). On a side, the fraction of a line is that of the chord. The cells are ordered row by
/// row, the lowest first.
class SideGrid {
 public:
  /// Throws as BladeContours::at and regionLine; rows and columns must be above 0. An edge's region reaches
  /// kEdgeReach to either side.
  SideGrid(const BladeContours& contours, BladeRegion region, int rows, int columns);

  BladeRegion region() const { return region_; }
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

  BladeRegion region_;
  std::size_t rows_, columns_;
  std::vector<Vec3> corners_;
  std::vector<ContourPoint> middles_;
  std::vector<double> areas_;  // mm²
};

}  // namespace octoblisk::demos
