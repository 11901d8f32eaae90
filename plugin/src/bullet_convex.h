// Bullet's convex shapes as Convex bodies (octoblisk/convex.h).
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <span>
#include <vector>

#include "octoblisk/convex.h"
#include "octoblisk/hull_faces.h"

namespace octoblisk::detail {

/// A circle around an axis of the frame, on which a cylinder or a cone stands.
struct Rim {
  int axis;
  double height, radius;
};

/// The core of a convex shape: its corners, if it is the hull of a few points, and the points on which it may
/// stand.
class ConvexCore {
 public:
  /// Reads the shape; returns whether it was scaled, or got other points, since the last call. If not,
  /// allocates nothing.
  bool update(const btConvexShape& shape);

  std::span<const Vec3> points() const { return points_; }
  /// A point inside: the mean of the points, the origin of a cylinder or cone, otherwise a mean of support
  /// points.
  const Vec3& middle() const { return middle_; }
  /// Of the hull of points(); found by the first call after a change, because most bodies are near nothing.
  HullFaces faces();
  /// Whether the body has corners or rims; a sphere has none.
  bool hasFeet() const { return points_.size() > 1 || !rims_.empty(); }
  /// The points on which the body may stand if it is pushed along a unit vector. The hull of a few points has
  /// its corners. A rim of a cylinder or a cone has its farthest point, or points all around if the rim is
  /// nearly perpendicular to the vector. Empty for other shapes. Valid until the next call.
  std::span<const Vec3> feet(const Vec3& towards);

 private:
  std::vector<Vec3> points_, read_, feet_;
  std::vector<Rim> rims_;
  Vec3 middle_ = Vec3::Zero();
  HullFaceList faces_;
  bool has_faces_ = false;
};

/// A convex shape of Bullet as a Convex: both are a core and a margin around it. The corners must be up to
/// date. For one thread at a time, because faces() changes them.
class BulletConvex final : public Convex {
 public:
  BulletConvex(const btConvexShape& shape, ConvexCore& core)
      : shape_(shape), core_(core), margin_(double(shape.getMarginNonVirtual())) {}

  Vec3 support(const Vec3& direction) const override;
  double radius() const override { return margin_; }
  Vec3 middle() const override { return core_.middle(); }
  double precision() const override;
  std::span<const Vec3> points() const override { return core_.points(); }
  HullFaces faces() const override { return core_.faces(); }

 private:
  const btConvexShape& shape_;
  ConvexCore& core_;
  const double margin_;
};

}  // namespace octoblisk::detail
