// The part of a surface that is near another body.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "contact/shared_corners.h"
#include "geometry/triangle_feature.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Some triangles of a surface, numbered from 0, and which of them share corners and edges. Corners are the
/// same if their positions are equal. Allocates nothing once warm.
class LocalSurface {
 public:
  void clear() {
    triangles_.clear();
    corners_.clear();
    edges_.clear();
    numbers_.clear();
  }

  /// Adds the triangle that triangleOf() returns, unless it has been added before. `index` identifies it.
  /// Returns its number.
  template <typename TriangleOf>
  std::uint32_t add(std::uint32_t index, TriangleOf&& triangleOf) {
    if (2 * triangles_.size() >= numbers_.size()) grow();
    std::uint32_t& number = numbers_[slotOf(index)];
    if (number != kNoIndex) return number;
    number = size();
    const Triangle triangle = triangleOf();
    triangles_.push_back({triangle, scaledNormal(triangle), roundingOf(triangle), index});
    const auto triangleAt = [&](std::uint32_t added) -> const Triangle& { return triangles_[added].corners; };
    corners_.addCorners(triangleAt);
    edges_.addEdges(triangleAt);
    return number;
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
  const Triangle& triangle(std::uint32_t number) const { return triangles_[number].corners; }
  /// scaledNormal of the triangle.
  const Vec3& normal(std::uint32_t number) const { return triangles_[number].normal; }
  /// Slack for the rounding of distances from the triangle.
  double rounding(std::uint32_t number) const { return triangles_[number].rounding; }
  std::uint32_t index(std::uint32_t number) const { return triangles_[number].index; }

  /// The least sines of the angle by which a triangle must lean: one that goes on in the same plane, and one
  /// at an angle.
  struct Lean {
    double flat, bent;
  };

  /// Whether another triangle beyond an edge or corner leans in `direction`. Considers only triangles for
  /// which accept(number) is true.
  template <typename Accept>
  bool leansBeyond(std::uint32_t triangle, unsigned feature, const Vec3& direction, const Lean& least,
                   Accept&& accept) const {
    const Triangle& own = triangles_[triangle].corners;
    const auto [first, second] = endsOf(feature);
    const Vec3 &from = own[first], &to = own[second];
    const auto isIt = [&](std::uint32_t other) {
      if (other == triangle) return false;
      const Triangle& shares = triangles_[other].corners;
      if (!hasCorner(shares, from) || !hasCorner(shares, to)) return false;
      const double lean = sineOfLean(shares, from, to, direction);
      return lean > least.flat && (lean > least.bent || areFlat(triangle, other)) && accept(other);
    };
    return first == second ? corners_.anyAt(from, isIt) : edges_.anyAlong(from, to, isIt);
  }

  /// Whether another triangle beyond an edge or corner leans towards `point`, and is nearer to it than
  /// `limit`. `from` is a point of this edge or corner.
  bool comesNearer(std::uint32_t triangle, unsigned feature, const Vec3& from, const Vec3& point,
                   double limit, const Lean& least) const {
    return leansBeyond(triangle, feature, (point - from).normalized(), least, [&](std::uint32_t other) {
      return distance(triangles_[other].corners, point) < limit;
    });
  }

 private:
  struct Numbered {
    Triangle corners;
    Vec3 normal;
    double rounding;
    std::uint32_t index;
  };

  static double roundingOf(const Triangle& triangle) {
    double farthest = 0.0, longest = 0.0;
    for (const Vec3& corner : triangle) {
      farthest = std::max(farthest, corner.cwiseAbs().maxCoeff());
      longest = std::max(longest, (corner - triangle[0]).squaredNorm());
    }
    return 1e-9 * std::sqrt(longest) + 1e-14 * farthest;
  }

  bool areFlat(std::uint32_t one, std::uint32_t other) const {
    constexpr double kFlat = 0.999;  // the cosine of 2.6°
    return normal(one).dot(normal(other)) > kFlat * normal(one).norm() * normal(other).norm();
  }

  /// The slot of a triangle in the table of numbers, or the empty slot for it.
  std::size_t slotOf(std::uint32_t index) const {
    const std::size_t last = numbers_.size() - 1;
    std::size_t slot = index * 0x9e3779b9u >> (32 - std::countr_zero(numbers_.size()));
    while (numbers_[slot] != kNoIndex && triangles_[numbers_[slot]].index != index) slot = (slot + 1) & last;
    return slot;
  }

  void grow() {
    numbers_.assign(std::max<std::size_t>(32, 2 * numbers_.size()), kNoIndex);
    for (std::uint32_t number = 0; number < size(); ++number) {
      numbers_[slotOf(triangles_[number].index)] = number;
    }
  }

  std::vector<Numbered> triangles_;
  std::vector<std::uint32_t> numbers_;  // hash table from index to number, at most half full
  SharedCorners corners_, edges_;
};

}  // namespace octoblisk::detail
