// Finds the triangles that share a corner.
#pragma once

#include <algorithm>
#include <bit>
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
  void clear() {
    corners_.clear();
    first_.clear();
  }
  void reserve(std::size_t triangles) { corners_.reserve(3 * triangles); }

  /// `index` identifies the triangle.
  void add(const Triangle& triangle, std::uint32_t index) {
    for (const Vec3& corner : triangle) corners_.push_back({keyOf(corner), index, kNone});
    if (areFew()) return;
    if (corners_.size() > first_.size()) {
      first_.assign(2 * std::bit_ceil(corners_.size()), kNone);
      for (std::uint32_t c = 0; c < corners_.size(); ++c) chain(c);
    } else {
      for (std::size_t c = corners_.size() - 3; c < corners_.size(); ++c)
        chain(static_cast<std::uint32_t>(c));
    }
  }

  /// Calls visit(index) for each triangle that has a corner at the position, and for few others, until a call
  /// returns true. Returns whether one did.
  template <typename Visit>
  bool anyAt(const Vec3& position, Visit&& visit) const {
    const double key = keyOf(position);
    if (areFew()) {
      return std::ranges::any_of(
          corners_, [&](const Corner& corner) { return corner.key == key && visit(corner.index); });
    }
    for (std::uint32_t c = first_[slotOf(key)]; c != kNone; c = corners_[c].next) {
      if (corners_[c].key == key && visit(corners_[c].index)) return true;
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  struct Corner {
    double key;
    std::uint32_t index;
    std::uint32_t next;  // corner in the same slot
  };

  /// Looking at all of a few corners takes less time than a table.
  bool areFew() const {
    constexpr std::size_t kFew = 48;
    return corners_.size() <= kFew;
  }

  /// Equal for equal positions, almost never for different ones.
  static double keyOf(const Vec3& position) {
    return position.dot(Vec3(1.0, 0.61803398874989485, 0.41421356237309505)) + 0.0;  // -0 is 0
  }

  std::size_t slotOf(double key) const {
    const std::uint64_t mixed = std::bit_cast<std::uint64_t>(key) * 0x9e3779b97f4a7c15u;
    return mixed >> (64 - std::countr_zero(first_.size()));
  }

  void chain(std::uint32_t corner) {
    std::uint32_t& first = first_[slotOf(corners_[corner].key)];
    corners_[corner].next = first;
    first = corner;
  }

  std::vector<Corner> corners_;
  std::vector<std::uint32_t> first_;  // per slot of the table: the corner added last; empty if there are few
};

}  // namespace octoblisk::detail
