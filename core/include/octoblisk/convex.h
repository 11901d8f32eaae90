// Convex bodies by their support function: all that GJK and EPA want to know of one.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "octoblisk/hull_faces.h"
#include "octoblisk/types.h"

namespace octoblisk {

/// A convex body: all points within `radius` of a convex core. Sphere: a point and a radius; capsule: a
/// segment and a radius; box: eight corners and none.
class Convex {
 public:
  virtual ~Convex() = default;

  /// The core's farthest point in a direction of any length but 0, in the body's frame.
  virtual Vec3 support(const Vec3& direction) const = 0;
  /// How far the body reaches beyond its core, mesh units.
  virtual double radius() const { return 0.0; }
  /// The error of support points, relative to their size: searches are not driven beyond it.
  virtual double precision() const { return 1e-12; }

  /// About the middle of the core: where searches begin.
  virtual Vec3 middle() const { return Vec3::Zero(); }
  /// Points whose hull is the core, where they are few: searches leave out more with them. Else none.
  virtual std::span<const Vec3> points() const { return {}; }
  /// The faces and edges of the hull of points(), where they are known: they make contacts exact and fast.
  virtual HullFaces faces() const { return {}; }

  /// The core's box along the axes of its frame.
  Aabb coreBounds() const {
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
      box.max[axis] = support(Vec3::Unit(axis))[axis];
      box.min[axis] = support(-Vec3::Unit(axis))[axis];
    }
    return box;
  }

  /// The body's box along the axes of its frame, radius included.
  Aabb bounds() const {
    const Aabb core = coreBounds();
    return {core.min.array() - radius(), core.max.array() + radius()};
  }
};

/// The first of the points that is farthest in a direction.
const Vec3& farthest(std::span<const Vec3> points, const Vec3& direction);

/// A few points whose hull holds a body's core: its own, or in `room` the corners of its box.
std::span<const Vec3> pointsRoundCore(const Convex& convex, std::array<Vec3, 8>& room);
inline constexpr std::size_t kMostPointsRoundCore = HullFaceList::kMostPoints;

/// The hull of some points, grown by a radius.
class ConvexHull final : public Convex {
 public:
  /// Throws std::invalid_argument for no points or a negative radius.
  explicit ConvexHull(std::vector<Vec3> points, double radius = 0.0);

  Vec3 support(const Vec3& direction) const override;
  double radius() const override { return radius_; }
  std::span<const Vec3> points() const override { return points_; }
  HullFaces faces() const override { return faces_.view(); }

 private:
  std::vector<Vec3> points_;
  HullFaceList faces_;
  double radius_;
};

/// A box, in the frame that its centre and axes are given in.
class ConvexBox final : public Convex {
 public:
  explicit ConvexBox(const Obb& box);

  Vec3 middle() const override { return box_.center; }
  Vec3 support(const Vec3& direction) const override {
    const Vec3 local = box_.axes.transpose() * direction;
    return box_.center + box_.axes * (local.array() < 0.0).select(-box_.half_extents, box_.half_extents);
  }
  std::span<const Vec3> points() const override { return points_; }
  HullFaces faces() const override { return {faces_, edges_}; }

 private:
  Obb box_;
  std::array<Vec3, 8> points_;     // bit k of the index: which end of axis k
  std::array<HullFace, 6> faces_;  // 2k and 2k + 1: the lower and the upper end of axis k
  std::array<HullEdge, 12> edges_;
};

}  // namespace octoblisk
