#include "cast_callbacks.h"

#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <cmath>

#include "bullet_convex.h"
#include "octoblisk/motion.h"
#include "octoblisk_bullet/convert.h"
#include "query/triangle_sweep.h"
#include "query/triangles_along.h"
#include "shape_bounds.h"

namespace octoblisk::detail {
namespace {

/// The relative error of coordinates after computations in Bullet's precision.
constexpr double kRounding = 64.0 * double(SIMD_EPSILON);

double largest(const Vec3& vector) { return vector.cwiseAbs().maxCoeff(); }

void castRay(btTriangleRaycastCallback& ray, const TriangleHandover& hand_over) {
  // Bullet counts a ray as a hit beside a triangle if a barycentric weight is as low as −1e-4.
  constexpr double kRim = 1e-3;
  const Vec3 from = fromBullet(ray.m_from), way = fromBullet(ray.m_to) - from;
  const double rounding =
      kRounding * (largest(from) + largest(way) + largest(hand_over.tree().mesh().bounds().center()));
  MovingBox segment = movingPoint(from, way, rounding);
  segment.rim = kRim;
  forEachTriangleAlong(hand_over.tree(), segment, double(ray.m_hitFraction),
                       [&](std::uint32_t triangle, double) {
                         hand_over(ray, triangle);
                         return double(ray.m_hitFraction);
                       });
}

/// A convex body that Bullet sweeps, in the frame of the triangles.
struct ConvexSweep {
  Motion motion;
  double tolerance;  ///< of distances
  double distance;   ///< from the triangles, at an impact
  MovingBox box;     ///< around the body, as large as that distance

  explicit ConvexSweep(const btTriangleConvexcastCallback& sweep)
      : motion(fromBullet(sweep.m_triangleToWorld).inverse() * fromBullet(sweep.m_convexShapeFrom),
               fromBullet(sweep.m_triangleToWorld).inverse() * fromBullet(sweep.m_convexShapeTo)),
        distance(double(sweep.m_triangleCollisionMargin) - double(sweep.m_allowedPenetration)) {
    const Pose& from = motion.from();
    const Aabb bounds = shapeBounds(*sweep.m_convexShape);
    box.motion = motion.advance();
    if (motion.angle() == 0.0) {
      box.start = from * obbOf(bounds);
    } else {
      box.start = {from.translation, Mat3::Identity(), Vec3::Constant(bounds.farthestFromOrigin())};
    }
    // The rounding of two poses in Bullet's precision, and that of searches for closest points.
    const double precision = std::max(8.0 * double(SIMD_EPSILON), 1e-9);
    tolerance = precision * (largest(from.translation) + largest(box.motion) + box.start.half_extents.norm() +
                             largest(fromBullet(sweep.m_convexShapeFrom.getOrigin())));
    box.start.half_extents.array() += std::max(0.0, distance) + 2.0 * tolerance;
  }
};

void castConvex(btTriangleConvexcastCallback& callback, const TriangleHandover& hand_over) {
  ConvexCore support_only;
  const BulletConvex convex(*callback.m_convexShape, support_only);
  const ConvexSweep sweep(callback);
  const btTransform& to_world = callback.m_triangleToWorld;
  btScalar last = callback.m_hitFraction;
  forEachTriangleAlong(hand_over.tree(), sweep.box, double(last), [&](std::uint32_t triangle, double) {
    const std::optional<TriangleImpact> impact =
        detail::sweep(hand_over.tree().mesh().triangle(triangle), convex, sweep.motion, sweep.distance,
                      sweep.tolerance, double(last));
    if (!impact) return double(last);
    const btScalar fraction = btScalar(impact->fraction);
    const Vec3 to_convex = -impact->contact.normal;
    const Vec3 point = impact->contact.point_on_a + double(callback.m_triangleCollisionMargin) * to_convex;
    const TriangleId id = hand_over.id(triangle);
    const btScalar wanted = callback.reportHit(to_world.getBasis() * toBullet(to_convex),
                                               to_world * toBullet(point), fraction, id.part, id.index);
    last = std::min(last, callback.m_hitFraction);
    // Other callbacks return any value, because Bullet ignores it: 0 or 1 from callbacks that want all hits.
    if (wanted == fraction) last = std::min(last, fraction);
    return double(last);
  });
}

}  // namespace

void TriangleHandover::operator()(btTriangleCallback& callback, std::uint32_t triangle) const {
  const Triangle exact = tree_.mesh().triangle(triangle);
  if (!boundsOf(exact).meets(box_)) return;
  btVector3 corners[3] = {toBullet(exact[0]), toBullet(exact[1]), toBullet(exact[2])};
  const TriangleId id = parts_.id(triangle);
  callback.processTriangle(corners, id.part, id.index);
}

bool castTriangles(btTriangleCallback& callback, const TriangleHandover& hand_over) {
  if (auto* ray = dynamic_cast<btTriangleRaycastCallback*>(&callback)) {
    castRay(*ray, hand_over);
    return true;
  }
  if (auto* sweep = dynamic_cast<btTriangleConvexcastCallback*>(&callback)) {
    castConvex(*sweep, hand_over);
    return true;
  }
  return false;
}

}  // namespace octoblisk::detail
