// Basic types: vectors, poses, boxes.
//
// The library has no fixed unit: lengths are in "mesh units", the unit of the caller's mesh. Poses name their
// frames: `belt_in_blisk` takes points from the belt's frame to the blisk's.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "octoblisk/cpp20.h"

namespace octoblisk {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// A rigid motion: x ↦ rotation · x + translation. The rotation is orthonormal. At a pose that is not finite,
/// bodies do not meet and their distance is infinite.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();

  Vec3 operator*(const Vec3& point) const { return rotation * point + translation; }
  Pose operator*(const Pose& inner) const {
    return {rotation * inner.rotation, rotation * inner.translation + translation};
  }
  bool isFinite() const { return rotation.allFinite() && translation.allFinite(); }
  Pose inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
};

/// An axis-aligned box. The default is empty, so that `extend` can start from it.
struct Aabb {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Vec3& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  /// Also true if a bound is NaN.
  bool isEmpty() const { return !(min.array() <= max.array()).all(); }
  /// Whether the closed boxes share a point.
  bool meets(const Aabb& other) const {
    return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
  }
  /// The box with each side moved outward by a distance.
  Aabb grown(double by) const { return {min.array() - by, max.array() + by}; }
  Vec3 center() const { return 0.5 * (min + max); }
  Vec3 halfExtents() const { return 0.5 * (max - min); }
  /// The greatest distance of a point of the box from the origin.
  double farthestFromOrigin() const { return min.cwiseAbs().cwiseMax(max.cwiseAbs()).norm(); }

  /// Bit k of a corner's index is 1 at the greater end of axis k.
  std::array<Vec3, 8> corners() const {
    std::array<Vec3, 8> all;
    for (std::size_t c = 0; c < 8; ++c) {
      for (int k = 0; k < 3; ++k) all[c][k] = (c >> k & 1u) != 0 ? max[k] : min[k];
    }
    return all;
  }
};

/// The axis-aligned bounding box of points.
inline Aabb boundsOf(std::span<const Vec3> points) {
  Aabb bounds;
  for (const Vec3& point : points) bounds.extend(point);
  return bounds;
}

/// An oriented box: the points center + axes · x with |x_i| <= half_extents_i.
struct Obb {
  Vec3 center = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  ///< columns: an orthonormal, right-handed frame
  Vec3 half_extents = Vec3::Zero();

  double volume() const { return 8.0 * half_extents.prod(); }

  /// In the order of Aabb::corners.
  std::array<Vec3, 8> corners() const {
    std::array<Vec3, 8> all = Aabb{-half_extents, half_extents}.corners();
    for (Vec3& corner : all) corner = center + axes * corner;
    return all;
  }

  /// Whether the point lies in the box grown by `tolerance` on each side.
  bool contains(const Vec3& point, double tolerance = 0.0) const {
    return ((axes.transpose() * (point - center)).cwiseAbs().array() <= half_extents.array() + tolerance)
        .all();
  }
};

inline Obb obbOf(const Aabb& box) { return {box.center(), Mat3::Identity(), box.halfExtents()}; }

inline Obb operator*(const Pose& pose, const Obb& box) {
  return {pose * box.center, pose.rotation * box.axes, box.half_extents};
}

}  // namespace octoblisk
