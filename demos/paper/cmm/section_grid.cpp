#include "paper/cmm/section_grid.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace octoblisk::demos {

SectionGrid::SectionGrid(std::vector<double> heights, const std::vector<std::vector<SectionPoint>>& rows,
                         bool closed)
    : heights_(std::move(heights)), closed_(closed) {
  if (rows.size() < 2 || rows.size() != heights_.size()) {
    throw std::invalid_argument("a grid of sections needs at least two rows, and one height per row");
  }
  stations_ = rows.front().size();
  if (stations_ < 3) throw std::invalid_argument("a grid of sections needs at least three stations");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].size() != stations_) {
      throw std::invalid_argument("row " + std::to_string(row) + " has another number of stations");
    }
    if (row > 0 && !(heights_[row] > heights_[row - 1])) {
      throw std::invalid_argument("row " + std::to_string(row) + " is not above the previous row");
    }
    for (const SectionPoint& point : rows[row]) {
      points_.push_back({.position = point.position, .flat = point.flat});
    }
  }
  measureSections();
  findNormals();
}

std::size_t SectionGrid::next(std::size_t station) const {
  if (station + 1 < stations_) return station + 1;
  return closed_ ? 0 : station;
}

std::size_t SectionGrid::last(std::size_t station) const {
  if (station > 0) return station - 1;
  return closed_ ? stations_ - 1 : 0;
}

double SectionGrid::cellBottom(std::size_t row) const {
  return row > 0 ? 0.5 * (heights_[row - 1] + heights_[row]) : heights_[row];
}

double SectionGrid::cellTop(std::size_t row) const {
  return row + 1 < rows() ? 0.5 * (heights_[row] + heights_[row + 1]) : heights_[row];
}

double SectionGrid::length(std::size_t row) const {
  const Point& end = at(row, stations_ - 1);
  return closed_ ? end.arc + (at(row, 0).flat - end.flat).norm() : end.arc;
}

void SectionGrid::measureSections() {
  for (std::size_t row = 0; row < rows(); ++row) {
    for (std::size_t k = 0; k < stations_; ++k) {
      Point& point = points_[index(row, k)];
      const double before = (point.flat - at(row, last(k)).flat).norm();
      const double after = (at(row, next(k)).flat - point.flat).norm();
      if ((last(k) != k && before == 0.0) || (next(k) != k && after == 0.0)) {
        throw std::invalid_argument("row " + std::to_string(row) + " has two stations at one place, at " +
                                    std::to_string(k));
      }
      point.width = 0.5 * (before + after);
      if (k > 0) point.arc = at(row, k - 1).arc + before;
    }
  }
}

void SectionGrid::findNormals() {
  double area = 0.0;  // twice the first section's area, positive if it turns to the left
  for (std::size_t k = 0; k < stations_ && closed_; ++k) {
    const Vec2& from = at(0, k).flat;
    const Vec2& to = at(0, next(k)).flat;
    area += from.x() * to.y() - from.y() * to.x();
  }
  outward_ = area > 0.0 ? -1.0 : 1.0;
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::size_t above = row + 1 < rows() ? row + 1 : row;
    const std::size_t below = row > 0 ? row - 1 : row;
    for (std::size_t k = 0; k < stations_; ++k) {
      const Point &before = at(row, last(k)), &after = at(row, next(k));
      const Vec2 flat_along = (after.flat - before.flat).normalized();
      const Vec3 along = after.position - before.position;
      const Vec3 up = at(above, k).position - at(below, k).position;
      Point& point = points_[index(row, k)];
      point.flat_normal = outward_ * Vec2(-flat_along.y(), flat_along.x());
      point.normal = outward_ * along.cross(up).normalized();
    }
  }
}

TriangleMesh SectionGrid::displaced(std::span<const double> displacements) const {
  if (displacements.size() != size())
    throw std::invalid_argument("the numbers of displacements and points differ");
  std::vector<Vec3> vertices;
  for (std::size_t k = 0; k < size(); ++k) {
    vertices.push_back(points_[k].position + displacements[k] * points_[k].normal);
  }
  std::vector<TriangleMesh::Indices> triangles;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    if (outward_ < 0.0) std::swap(b, c);
    triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  };
  for (std::size_t row = 0; row + 1 < rows(); ++row) {
    for (std::size_t k = 0; k < stations_; ++k) {
      if (next(k) == k) continue;
      add(index(row, k), index(row, next(k)), index(row + 1, next(k)));
      add(index(row, k), index(row + 1, next(k)), index(row + 1, k));
    }
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

}  // namespace octoblisk::demos
