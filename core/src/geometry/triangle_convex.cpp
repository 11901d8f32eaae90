#include "geometry/triangle_convex.h"

#include "geometry/epa.h"
#include "geometry/gjk.h"
#include "geometry/thin_triangle.h"
#include "geometry/triangle_capsule.h"
#include "geometry/triangle_polyhedron.h"

namespace octoblisk::detail {
namespace {

CoreContact penetrationOfCore(const Triangle& triangle, const Convex& convex, const GjkResult& search) {
  if (const std::optional<CoreContact> found = epa(triangle, convex, search.simplex)) return *found;
  const Vec3 normal = scaledNormal(triangle);
  const Vec3 direction = normal.squaredNorm() > 0.0 ? Vec3(-normal.normalized()) : Vec3::UnitX();
  return {0.0, direction, search.on_triangle, search.on_core};
}

/// None if core and triangle are farther apart than the limit.
std::optional<CoreContact> searched(const Triangle& triangle, const Convex& convex, double limit) {
  const GjkResult search = gjk(triangle, convex, limit);
  if (search.beyond_limit) return std::nullopt;
  const Vec3 apart = search.on_triangle - search.on_core;
  const double distance = apart.norm();
  if (search.overlap || distance == 0.0) return penetrationOfCore(triangle, convex, search);
  return CoreContact{distance, apart / distance, search.on_triangle, search.on_core};
}

std::optional<CoreContact> contactOfCore(const Triangle& triangle, const Convex& convex, double limit) {
  const std::span<const Vec3> points = convex.points();
  if (points.size() == 1) return contactOfPoint(triangle, points[0]);
  if (isThin(triangle)) return searched(triangle, convex, limit);  // without the normal
  if (points.size() == 2) return contactOfSegment(triangle, points[0], points[1]);
  const HullFaces faces = convex.faces();
  if (!canSearchAxes(points, faces)) return searched(triangle, convex, limit);
  const AxisSearch along = searchAxes(triangle, points, faces, limit);
  switch (along.verdict) {
    case AxisSearch::Verdict::beyond_limit:
      return std::nullopt;
    case AxisSearch::Verdict::contact:
      return along.contact;
    case AxisSearch::Verdict::apart:
      break;
  }
  return searched(triangle, convex, limit);
}

/// The contact with the body around the core, if it is within the threshold.
std::optional<Contact> grown(const std::optional<CoreContact>& core, double radius, double threshold) {
  if (!core || core->distance - radius > threshold) return std::nullopt;
  return Contact{core->on_triangle, core->on_core + radius * core->normal, core->normal,
                 core->distance - radius};
}

}  // namespace

std::optional<Contact> contactOf(const Triangle& triangle, const Convex& convex, double threshold) {
  const double radius = convex.radius();
  return grown(contactOfCore(triangle, convex, threshold + radius), radius, threshold);
}

PosedConvex::PosedConvex(const Convex& convex, const Pose& pose)
    : convex_(convex), pose_(pose), inverse_(pose.inverse()), radius_(convex.radius()) {
  if (convex.points().size() == 1) center_ = pose * convex.points()[0];
}

std::optional<Contact> PosedConvex::contactWith(const Triangle& triangle, double threshold) const {
  if (center_) return grown(contactOfPoint(triangle, *center_), radius_, threshold);
  std::optional<Contact> contact = contactOf(inverse_ * triangle, convex_, threshold);
  if (contact) {
    contact->point_on_a = pose_ * contact->point_on_a;
    contact->point_on_b = pose_ * contact->point_on_b;
    contact->normal = pose_.rotation * contact->normal;
  }
  return contact;
}

}  // namespace octoblisk::detail
