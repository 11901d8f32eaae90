#include "bullet_convex.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {
namespace {

/// The corners of a shape's core, if it is the hull of a few.
void readCorners(const btConvexShape& shape, std::vector<Vec3>& corners) {
  corners.clear();
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE:
      corners.emplace_back(Vec3::Zero());
      break;
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      const Vec3 half = double(capsule.getHalfHeight()) * Vec3::Unit(capsule.getUpAxis());
      corners.assign({-half, half});
      break;
    }
    case BOX_SHAPE_PROXYTYPE: {
      const Vec3 half = fromBullet(static_cast<const btBoxShape&>(shape).getHalfExtentsWithoutMargin());
      for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
          for (const double z : {-1.0, 1.0}) corners.emplace_back(half.cwiseProduct(Vec3(x, y, z)));
        }
      }
      break;
    }
    case CONVEX_HULL_SHAPE_PROXYTYPE: {
      const auto& hull = static_cast<const btConvexHullShape&>(shape);
      const Vec3 scaling = fromBullet(hull.getLocalScalingNV());
      corners.resize(static_cast<std::size_t>(hull.getNumPoints()));
      const btVector3* const points = hull.getUnscaledPoints();
      for (std::size_t p = 0; p < corners.size(); ++p)
        corners[p] = fromBullet(points[p]).cwiseProduct(scaling);
      break;
    }
    default:
      break;
  }
}

/// The rims of a shape's core, if it is a cylinder or a cone.
void readRims(const btConvexShape& shape, std::vector<Rim>& rims) {
  rims.clear();
  if (shape.getShapeType() == CYLINDER_SHAPE_PROXYTYPE) {
    const auto& cylinder = static_cast<const btCylinderShape&>(shape);
    const int axis = cylinder.getUpAxis();
    const Vec3 half = fromBullet(cylinder.getHalfExtentsWithoutMargin());
    const double radius = half[axis == 0 ? 1 : 0];  // the one that Bullet takes
    for (const double side : {-1.0, 1.0}) rims.push_back({axis, side * half[axis], radius});
  } else if (shape.getShapeType() == CONE_SHAPE_PROXYTYPE) {
    const auto& cone = static_cast<const btConeShape&>(shape);
    rims.push_back({cone.getConeUpIndex(), -0.5 * double(cone.getHeight()), double(cone.getRadius())});
  }
}

Vec3 supportOf(const btConvexShape& shape, const Vec3& direction) {
  return fromBullet(shape.localGetSupportVertexWithoutMarginNonVirtual(toBullet(direction)));
}

/// The mean of the farthest points along the axes: a point inside the shape. The origin may be outside.
Vec3 middleOf(const btConvexShape& shape) {
  Vec3 middle = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) middle += supportOf(shape, side * Vec3::Unit(axis)) / 6.0;
  }
  return middle;
}

}  // namespace

bool ConvexCore::update(const btConvexShape& shape) {
  readCorners(shape, read_);
  const bool is_same = read_ == points_;
  std::swap(read_, points_);
  readRims(shape, rims_);
  if (points_.empty()) {
    middle_ = rims_.empty() ? middleOf(shape) : Vec3::Zero();
  } else if (!is_same) {
    middle_ = std::accumulate(points_.begin(), points_.end(), Vec3(Vec3::Zero())) / double(points_.size());
  }
  if (!is_same) has_faces_ = false;
  return !is_same;
}

std::span<const Vec3> ConvexCore::feet(const Vec3& towards) {
  if (!points_.empty()) return points_;
  constexpr double kLeastTilt = 0.2;  // the sine of 12°
  constexpr double kDiagonal = 0.5 * std::numbers::sqrt2;
  constexpr double kAround[8][2] = {{1, 0},  {kDiagonal, kDiagonal},   {0, 1},  {-kDiagonal, kDiagonal},
                                    {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}};
  feet_.clear();
  for (const Rim& rim : rims_) {
    const Vec3 middle = rim.height * Vec3::Unit(rim.axis);
    Vec3 across = towards;
    across[rim.axis] = 0.0;
    if (across.norm() > kLeastTilt) {
      // Other points of a rim that rolls would brake it: they come down, but the rim does not.
      feet_.push_back(middle + rim.radius * across.normalized());
      continue;
    }
    for (const auto& [x, y] : kAround) {
      Vec3& point = feet_.emplace_back(middle);
      point[(rim.axis + 1) % 3] = rim.radius * x;
      point[(rim.axis + 2) % 3] = rim.radius * y;
    }
  }
  return feet_;
}

HullFaces ConvexCore::faces() {
  if (!has_faces_) faces_.find(points_);
  has_faces_ = true;
  return faces_.view();
}

Vec3 BulletConvex::support(const Vec3& direction) const {
  if (!core_.points().empty()) return farthest(core_.points(), direction);
  return supportOf(shape_, direction.normalized());
}

double BulletConvex::precision() const {
  return core_.points().empty() ? std::max(16.0 * double(SIMD_EPSILON), 1e-9) : Convex::precision();
}

}  // namespace octoblisk::detail
