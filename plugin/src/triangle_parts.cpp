#include "octoblisk_bullet/triangle_parts.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace octoblisk {

TriangleParts::TriangleParts(std::vector<std::uint32_t> begin, std::size_t triangle_count)
    : begin_(std::move(begin)) {
  if (begin_.empty() || begin_.front() != 0) {
    throw std::invalid_argument("the first part of a mesh must begin with triangle 0");
  }
  if (begin_.size() > kMaxParts) {
    throw std::invalid_argument("the mesh has " + std::to_string(begin_.size()) +
                                " parts; Bullet numbers at most " + std::to_string(kMaxParts));
  }
  begin_.push_back(static_cast<std::uint32_t>(triangle_count));
  for (std::size_t part = 0; part < count(); ++part) {
    if (begin_[part] > begin_[part + 1]) {
      throw std::invalid_argument("part " + std::to_string(part) + " of the mesh begins with triangle " +
                                  std::to_string(begin_[part]) + " and ends before " +
                                  std::to_string(begin_[part + 1]));
    }
    const std::size_t triangles = begin_[part + 1] - begin_[part];
    if (triangles > kMaxTriangles) {
      throw std::invalid_argument("part " + std::to_string(part) + " of the mesh has " +
                                  std::to_string(triangles) + " triangles; Bullet numbers at most " +
                                  std::to_string(kMaxTriangles) + " per part");
    }
  }
}

TriangleId TriangleParts::id(std::uint32_t triangle) const {
  const auto next_part = std::upper_bound(begin_.begin(), begin_.end() - 1, triangle);
  const auto part = static_cast<int>(next_part - begin_.begin()) - 1;
  return {part, static_cast<int>(triangle - *(next_part - 1))};
}

}  // namespace octoblisk
