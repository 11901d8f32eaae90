#include "contact/foot_contacts.h"

#include <algorithm>
#include <cmath>

#include "geometry/triangle_feature.h"

namespace octoblisk::detail {

void addFootContacts(const TriangleMesh& mesh, FindFeet feet, double radius, const Pose& convex_in_mesh,
                     double threshold, std::size_t of_triangles, std::vector<Contact>& contacts) {
  if (contacts.empty()) return;
  constexpr double kGrazing = 0.1;
  const double deepest = std::ranges::min_element(contacts, {}, &Contact::distance)->distance;
  for (std::size_t c = 0; c < of_triangles; ++c) {
    const Contact of_triangle = contacts[c];
    const Triangle triangle = mesh.triangle(of_triangle.triangle_a);
    const Vec3 facing = scaledNormal(triangle);
    // Points to the side of the triangle from which the body pushes.
    Vec3 normal = facing.normalized();
    const double along = normal.dot(of_triangle.normal);
    if (!(std::abs(along) > kGrazing)) continue;
    if (along < 0.0) normal = -normal;
    for (const Vec3& point : feet(convex_in_mesh.rotation.transpose() * normal)) {
      const Vec3 foot = convex_in_mesh * point;
      const double height = (triangle[0] - foot).dot(normal), distance = height - radius;
      if (distance > threshold || distance < deepest || !isOver(triangle, facing, foot)) continue;
      const Vec3 on_convex = foot + radius * normal;
      if ((on_convex - of_triangle.point_on_b).squaredNorm() < 1e-12 * facing.norm())
        continue;  // the contact itself
      contacts.push_back(
          {foot + height * normal, on_convex, normal, distance, of_triangle.triangle_a, kNoTriangle});
    }
  }
}

}  // namespace octoblisk::detail
