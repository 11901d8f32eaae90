// The part of a surface that is near another body.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/shared_corners.h"
#include "geometry/triangle_feature.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Some triangles of a surface, numbered from 0, and which of them share a corner. Corners are shared if
/// their positions are equal to the last bit. Allocates nothing once warm.
class LocalSurface {
 public:
  void clear() {
    triangles_.clear();
    corners_.clear();
  }

  /// Adds a triangle unless it has been added before. `index` identifies it. Returns its number.
  std::uint32_t add(std::uint32_t index, const Triangle& triangle) {
    std::uint32_t number = 0;
    const auto isIt = [&](std::uint32_t other) {
      number = other;
      return triangles_[other].index == index;
    };
    if (corners_.anyAt(triangle[0], isIt)) return number;
    number = size();
    triangles_.push_back({triangle, index});
    corners_.add(triangle, number);
    return number;
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
  const Triangle& triangle(std::uint32_t number) const { return triangles_[number].corners; }
  std::uint32_t index(std::uint32_t number) const { return triangles_[number].index; }

  /// Whether beyond an edge or corner of a triangle, by at least `least_sine`, another triangle leans in
  /// `direction` for which accept(number) is true.
  template <typename Accept>
  bool leansBeyond(std::uint32_t triangle, unsigned feature, const Vec3& direction, double least_sine,
                   Accept&& accept) const {
    const Triangle& own = triangles_[triangle].corners;
    const auto [first, second] = endsOf(feature);
    return corners_.anyAt(own[first], [&](std::uint32_t other) {
      if (other == triangle) return false;
      const Triangle& shares = triangles_[other].corners;
      return hasCorner(shares, own[first]) && hasCorner(shares, own[second]) &&
             leansOver(shares, own[first], own[second], direction, least_sine) && accept(other);
    });
  }

  /// Whether the surface comes nearer than `distance` to a point beyond an edge or corner of a triangle, and
  /// leans towards the point there by at least `least_sine`. `from` is a point of this edge or corner.
  bool comesNearer(std::uint32_t triangle, unsigned feature, const Vec3& from, const Vec3& point,
                   double distance, double least_sine) const {
    const Vec3 way = point - from;
    return leansBeyond(triangle, feature, way.normalized(), least_sine, [&](std::uint32_t other) {
      return std::ranges::any_of(triangles_[other].corners, [&](const Vec3& corner) {
        const Vec3 along = corner - from;
        const double most = along.squaredNorm();
        if (!(most > 0.0)) return false;
        const double fraction = std::clamp(along.dot(way) / most, 0.0, 1.0);
        return (fraction * along - way).squaredNorm() < distance * distance;
      });
    });
  }

 private:
  struct Numbered {
    Triangle corners;
    std::uint32_t index;
  };

  std::vector<Numbered> triangles_;
  SharedCorners corners_;
};

}  // namespace octoblisk::detail
