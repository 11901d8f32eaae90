#include "contact/way_out_of_solid.h"

#include "octoblisk/closest_point.h"

namespace octoblisk::detail {

Contact wayOutOfSolid(const ClusteredOctree& a, const Vec3& inside,
                      FunctionRef<Vec3(const Vec3& direction)> farthest_of_b, double upper_bound) {
  const ClosestPoint closest = *closestPoint(a, inside, upper_bound);
  const double on_surface = 1e-9 * a.mesh().bounds().halfExtents().norm();
  const Vec3 facing = scaledNormal(a.mesh().triangle(closest.triangle));
  Vec3 inward = closest.distance > on_surface || facing.isZero(0.0) ? Vec3(inside - closest.point) : -facing;
  if (inward.isZero(0.0)) inward = Vec3::UnitX();  // on a triangle without area
  Contact contact;
  contact.normal = inward.normalized();
  contact.point_on_a = closest.point;
  contact.point_on_b = farthest_of_b(contact.normal);
  contact.distance = (contact.point_on_a - contact.point_on_b).dot(contact.normal);
  contact.triangle_a = closest.triangle;
  return contact;
}

}  // namespace octoblisk::detail
