// Finds the triangles that share a corner.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

inline bool hasCorner(const Triangle& triangle, const Vec3& position) {
  return std::ranges::find(triangle, position) != triangle.end();
}

/// Triangles by the positions of their corners. Allocates nothing once warm.
class SharedCorners {
 public:
  void clear() { corners_.clear(); }
  void reserve(std::size_t triangles) { corners_.reserve(3 * triangles); }
  bool empty() const { return corners_.empty(); }

  /// `index` identifies the triangle.
  void add(const Triangle& triangle, std::uint32_t index) {
    for (const Vec3& corner : triangle) corners_.push_back({keyOf(corner), index});
  }

  /// Call this after the last add.
  void sort() {
    if (!areFew()) std::ranges::sort(corners_, {}, &Corner::key);
  }

  /// Calls visit(index) for each triangle that has a corner at the position, and for few others, until a call
  /// returns true.
  template <typename Visit>
  void forEachAt(const Vec3& position, Visit&& visit) const {
    const double key = keyOf(position);
    if (areFew()) {
      for (const Corner& corner : corners_) {
        if (corner.key == key && visit(corner.index)) return;
      }
      return;
    }
    for (auto corner = std::ranges::lower_bound(corners_, key, {}, &Corner::key);
         corner != corners_.end() && corner->key == key; ++corner) {
      if (visit(corner->index)) return;
    }
  }

 private:
  struct Corner {
    double key;
    std::uint32_t index;
  };

  /// Sorting few corners takes longer than looking at all of them.
  bool areFew() const {
    constexpr std::size_t kFew = 48;
    return corners_.size() <= kFew;
  }

  /// Equal for equal positions, almost never for different ones.
  static double keyOf(const Vec3& position) {
    return position.dot(Vec3(1.0, 0.61803398874989485, 0.41421356237309505));
  }

  std::vector<Corner> corners_;
};

}  // namespace octoblisk::detail
