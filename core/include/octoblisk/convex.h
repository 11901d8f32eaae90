// Convex bodies, described by the support function that GJK and EPA use.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "octoblisk/hull_faces.h"
#include "octoblisk/types.h"

namespace octoblisk {

/// A convex body: all points within `radius` of a convex core. The core of a sphere is a point, that of a
/// capsule a segment. A box is a core of eight corners with radius 0.
class Convex {
 public:
  virtual ~Convex() = default;

  /// The farthest point of the core in a direction of any length but 0, in the body's frame.
  virtual Vec3 support(const Vec3& direction) const = 0;
  /// How far the body extends beyond its core, mesh units.
  virtual double radius() const { return 0.0; }
  /// The relative error of support points. Searches stop refining at this error.
  virtual double precision() const { return 1e-12; }

  /// A point near the middle of the core, where searches start.
  virtual Vec3 middle() const { return Vec3::Zero(); }
  /// Points whose hull is the core, if they are few; searches use them to skip more. Empty otherwise.
  virtual std::span<const Vec3> points() const { return {}; }
  /// The faces and edges of the hull of points(), if known, each once. They make contacts exact and fast, if
  /// there are at most HullFaceList::kMaxPoints points.
  virtual HullFaces faces() const { return {}; }

  /// The core's bounding box along the axes of the body's frame.
  Aabb coreBounds() const {
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
      box.max[axis] = support(Vec3::Unit(axis))[axis];
      box.min[axis] = support(-Vec3::Unit(axis))[axis];
    }
    return box;
  }

  /// The body's bounding box along the axes of its frame, radius included.
  Aabb bounds() const { return coreBounds().grown(radius()); }
};

/// The farthest of the points in a direction; the first of them if several tie.
const Vec3& farthest(std::span<const Vec3> points, const Vec3& direction);

/// The convex hull of points, grown by a radius.
class ConvexHull final : public Convex {
 public:
  /// Throws std::invalid_argument if there are no points or the radius is negative.
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

/// A box in the frame in which its centre and axes are given.
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
