#include "models/side_grid.h"

#include <algorithm>
#include <utility>

#include "models/contour_line.h"
#include "models/require.h"

namespace octoblisk::demos {
SideGrid::SideGrid(const BladeContours& contours, BladeRegion region, int rows, int columns)
    : region_(region) {
  require(rows > 0 && columns > 0, "the numbers of rows and columns must be above 0");
  rows_ = static_cast<std::size_t>(rows);
  columns_ = static_cast<std::size_t>(columns);
  const auto lineAt = [&](double height) {
    constexpr double kEnd = 1e-3;  // contours end at root and tip, which are corners of the mesh
    return regionLine(contours.at(std::clamp(height, kEnd, 1.0 - kEnd)), region, kEdgeReach);
  };
  for (std::size_t row = 0; row <= rows_; ++row) {
    const ContourLine line = lineAt(static_cast<double>(row) / rows);
    for (std::size_t column = 0; column <= columns_; ++column) {
      corners_.push_back(line.at(static_cast<double>(column) / columns).position);
    }
  }
  for (std::size_t row = 0; row < rows_; ++row) {
    const ContourLine line = lineAt(middle(row, rows_));
    for (std::size_t column = 0; column < columns_; ++column)
      middles_.push_back(line.at(middle(column, columns_)));
  }
  const TriangleMesh cells = mesh();
  for (std::size_t cell = 0; cell < middles_.size(); ++cell) {
    areas_.push_back(0.5 * (scaledNormal(cells.triangle(2 * cell)).norm() +
                            scaledNormal(cells.triangle(2 * cell + 1)).norm()));
  }
}

TriangleMesh SideGrid::mesh() const {
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t column = 0; column < columns_; ++column) {
      const auto at = [&](std::size_t up, std::size_t along) {
        return static_cast<std::uint32_t>(corner(row + up, column + along));
      };
      std::uint32_t a = at(0, 0), b = at(0, 1), c = at(1, 1), d = at(1, 0);
      const Vec3 normal = (corners_[b] - corners_[a]).cross(corners_[d] - corners_[a]);
      if (!middles_.empty() && normal.dot(middles_[row * columns_ + column].normal) < 0.0) std::swap(b, d);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return {corners_, std::move(triangles)};
}

}  // namespace octoblisk::demos
