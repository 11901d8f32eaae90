#include "contact/solid_contacts.h"

#include <algorithm>
#include <limits>

#include "contact/way_out_of_solid.h"

namespace octoblisk::detail {
namespace {

/// The radius of a ball around the middle of the core that is inside the body. -infinity if it is not known,
/// because the faces are not, or if the middle is outside the core.
double innerRadius(const Convex& convex) {
  constexpr double kUnknown = -std::numeric_limits<double>::infinity();
  const HullFaces hull = convex.faces();
  if (hull.empty()) return kUnknown;
  const Vec3 middle = convex.middle();
  double radius = std::numeric_limits<double>::infinity();
  for (const HullFace& face : hull.faces) radius = std::min(radius, face.offset - face.normal.dot(middle));
  return radius < 0.0 ? kUnknown : radius + convex.radius();
}

}  // namespace

void toSolidContacts(const SolidMesh& solid, const Convex& convex, const Pose& convex_in_mesh, double reach,
                     PointInSolid& middle, std::vector<Contact>& contacts) {
  const ClusteredOctree& tree = solid.boundary();
  const Vec3 center = convex_in_mesh * convex.middle();
  // A triangle that comes nearer to the middle is as much deeper in the ball around it.
  const auto leastClearance = [&] {
    double least_distance = reach;
    for (const Contact& contact : contacts) least_distance = std::min(least_distance, contact.distance);
    return innerRadius(convex) + least_distance;
  };
  const auto farthestOfConvex = [&](const Vec3& direction) -> Vec3 {
    return convex_in_mesh * convex.support(convex_in_mesh.rotation.transpose() * direction) +
           convex.radius() * direction;
  };
  if (middle.contains(solid, center, leastClearance)) {
    const Contact out = wayOutOfSolid(tree, center, farthestOfConvex);
    std::erase_if(contacts, [&](const Contact& contact) { return contact.normal.dot(out.normal) <= 0.0; });
    contacts.push_back(out);
    return;
  }
  // Triangles that the core pierces push it sideways. The way out of its end leads to its middle.
  Vec3 towards_end = Vec3::Zero();
  for (const Contact& contact : contacts) {
    if (contact.distance <= -convex.radius()) towards_end += contact.point_on_a - center;
  }
  if (!towards_end.isZero(0.0)) {
    const Vec3 end = convex_in_mesh * convex.support(convex_in_mesh.rotation.transpose() * towards_end);
    if (end != center && solid.contains(end)) {
      const auto farthestOfEnd = [&](const Vec3& direction) -> Vec3 {
        return end + convex.radius() * direction;
      };
      double upper_bound = std::numeric_limits<double>::infinity();
      for (const Contact& contact : contacts)
        upper_bound = std::min(upper_bound, distance(tree.mesh().triangle(contact.triangle_a), end));
      const Contact out = wayOutOfSolid(tree, end, farthestOfEnd, upper_bound);
      if (out.normal.dot(center - out.point_on_a) < 0.0) contacts.push_back(out);
    }
  }
  const auto pushesThrough = [&](const Contact& contact) {
    const double behind = contact.normal.dot(center - contact.point_on_a);
    return behind > 0.0 && behind <= -contact.distance;
  };
  const auto holds = [&](const Contact& contact) {
    return contact.distance <= 0.0 && !pushesThrough(contact);
  };
  if (std::ranges::any_of(contacts, holds)) std::erase_if(contacts, pushesThrough);
}

}  // namespace octoblisk::detail
