#include "models/side_grid.h"

#include <algorithm>
#include <utility>

#include "models/require.h"

namespace octoblisk::demos {
namespace {

/// Half of a contour, parametrised by the fraction of its length.
class Along {
 public:
  explicit Along(std::vector<ContourPoint> points) : points_(std::move(points)) {
    lengths_.push_back(0.0);
    for (std::size_t k = 1; k < points_.size(); ++k) {
      lengths_.push_back(lengths_.back() + (points_[k].position - points_[k - 1].position).norm());
    }
  }

  ContourPoint at(double part) const {
    const double length = part * lengths_.back();
    const auto above = std::ranges::upper_bound(lengths_, length) - lengths_.begin();
    const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, std::ssize(points_) - 1));
    const double step = lengths_[k] - lengths_[k - 1];
    const double within = step > 0.0 ? std::clamp((length - lengths_[k - 1]) / step, 0.0, 1.0) : 0.0;
    const ContourPoint &from = points_[k - 1], &to = points_[k];
    return {from.position + within * (to.position - from.position),
            (from.normal + within * (to.normal - from.normal)).normalized()};
  }

 private:
  std::vector<ContourPoint> points_;
  std::vector<double> lengths_;
};

}  // namespace

SideGrid::SideGrid(const BladeContours& contours, BladeSide side, int rows, int columns) : side_(side) {
  require(rows > 0 && columns > 0, "the numbers of rows and columns must be above 0");
  rows_ = static_cast<std::size_t>(rows);
  columns_ = static_cast<std::size_t>(columns);
  const auto lineAt = [&](double height) {
    constexpr double kEnd = 1e-3;  // contours end at root and tip, which are corners of the mesh
    BladeContour contour = contours.at(std::clamp(height, kEnd, 1.0 - kEnd));
    return Along(std::move(side == BladeSide::forward ? contour.forward : contour.backward));
  };
  for (std::size_t row = 0; row <= rows_; ++row) {
    const Along line = lineAt(static_cast<double>(row) / rows);
    for (std::size_t column = 0; column <= columns_; ++column) {
      corners_.push_back(line.at(static_cast<double>(column) / columns).position);
    }
  }
  for (std::size_t row = 0; row < rows_; ++row) {
    const Along line = lineAt(middle(row, rows_));
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
