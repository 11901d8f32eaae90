// A triangle that is cut by planes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// What cuts have left of a triangle: at most kMax corners, kMax >= 3.
template <std::size_t kMax>
class Polygon {
 public:
  explicit Polygon(const Triangle& triangle) : corner_{triangle[0], triangle[1], triangle[2]}, count_(3) {}

  std::span<const Vec3> corners() const { return {corner_.data(), count_}; }

  /// Keeps the part where height(point), a linear function, is not negative. Due to rounding, several edges
  /// may seem to cross the plane twice: n corners become 3 n / 2 at most. A cut that would leave more than
  /// kMax corners does nothing.
  template <typename Height>
  void cut(const Height& height) {
    std::array<double, kMax> heights;
    bool is_cut = false;
    for (std::size_t i = 0; i < count_; ++i) {
      heights[i] = height(corner_[i]);
      is_cut |= heights[i] < 0.0;
    }
    if (!is_cut) return;
    std::array<Vec3, kMax> kept;
    std::size_t kept_count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t next = i + 1 < count_ ? i + 1 : 0;
      const bool stays = heights[i] >= 0.0, crosses = stays != (heights[next] >= 0.0);
      if (kept_count + stays + crosses > kMax) return;
      const Vec3 &from = corner_[i], &to = corner_[next];
      if (stays) kept[kept_count++] = from;
      if (crosses) kept[kept_count++] = from + (to - from) * (heights[i] / (heights[i] - heights[next]));
    }
    std::copy_n(kept.begin(), kept_count, corner_.begin());
    count_ = kept_count;
  }

 private:
  std::array<Vec3, kMax> corner_;
  std::size_t count_;
};

}  // namespace octoblisk::detail
