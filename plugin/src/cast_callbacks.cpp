#include "cast_callbacks.h"

#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <cmath>

#include "octoblisk_bullet/convert.h"
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

/// Tests triangles like the callback's own class, passes its hits on, and keeps the fraction beyond which
/// hits no longer matter.
class ForwardingSweep final : public btTriangleConvexcastCallback {
 public:
  explicit ForwardingSweep(btTriangleConvexcastCallback& target)
      : btTriangleConvexcastCallback(target.m_convexShape, target.m_convexShapeFrom, target.m_convexShapeTo,
                                     target.m_triangleToWorld, target.m_triangleCollisionMargin),
        target_(target) {
    m_hitFraction = target.m_hitFraction;
    m_allowedPenetration = target.m_allowedPenetration;
  }

  btScalar reportHit(const btVector3& normal, const btVector3& point, btScalar fraction, int part,
                     int triangle) override {
    const btScalar wanted = target_.reportHit(normal, point, fraction, part, triangle);
    m_hitFraction = std::min(m_hitFraction, target_.m_hitFraction);
    // Other callbacks return any value, because Bullet ignores it: 0 or 1 from callbacks that want all hits.
    if (wanted == fraction) m_hitFraction = std::min(m_hitFraction, fraction);
    return wanted;
  }

 private:
  btTriangleConvexcastCallback& target_;
};

/// The box around a moving convex body, in the frame of the triangles.
MovingBox movingBoxOf(const btTriangleConvexcastCallback& sweep) {
  const btTransform to_triangles = sweep.m_triangleToWorld.inverse();
  const Pose from = fromBullet(to_triangles * sweep.m_convexShapeFrom);
  const Pose to = fromBullet(to_triangles * sweep.m_convexShapeTo);
  const Aabb bounds = shapeBounds(*sweep.m_convexShape);
  MovingBox box;
  box.motion = to.translation - from.translation;
  if (sweep.m_convexShapeFrom.getBasis() == sweep.m_convexShapeTo.getBasis()) {
    box.start = from * obbOf(bounds);
  } else {  // the body also turns about its origin
    const double radius = bounds.farthestFromOrigin();
    box.start = {from.translation, Mat3::Identity(), Vec3::Constant(radius)};
  }
  // Bullet's time of impact is when the bodies are this near, world units.
  constexpr double kImpactDistance = 0.001;
  const double size = largest(from.translation) + largest(to.translation) + box.start.half_extents.norm();
  box.start.half_extents.array() += 2.0 * kImpactDistance + std::abs(double(sweep.m_allowedPenetration)) +
                                    std::max(0.0, double(sweep.m_triangleCollisionMargin)) + kRounding * size;
  return box;
}

void castConvex(btTriangleConvexcastCallback& sweep, const TriangleHandover& hand_over) {
  ForwardingSweep forwarding(sweep);
  forEachTriangleAlong(hand_over.tree(), movingBoxOf(sweep), double(forwarding.m_hitFraction),
                       [&](std::uint32_t triangle, double) {
                         hand_over(forwarding, triangle);
                         return double(forwarding.m_hitFraction);
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
