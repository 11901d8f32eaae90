#include "contact/corner_contacts.h"

#include "geometry/triangle_feature.h"

namespace octoblisk::detail {
namespace {

bool isOver(const Triangle& triangle, const Vec3& normal, const Vec3& point) {
  for (std::size_t v = 0; v < 3; ++v) {
    if (normal.dot((triangle[(v + 1) % 3] - triangle[v]).cross(point - triangle[v])) < 0.0) return false;
  }
  return true;
}

}  // namespace

void addCornerContacts(const TriangleMesh& mesh, const Convex& convex, const Pose& convex_in_mesh,
                       double threshold, std::vector<Contact>& contacts) {
  if (convex.points().size() < 2) return;
  const std::size_t count = contacts.size();
  for (std::size_t c = 0; c < count; ++c) {
    const Contact deepest = contacts[c];
    const Triangle triangle = mesh.triangle(deepest.triangle_a);
    const Vec3 facing = scaledNormal(triangle);
    if (!isSquare(triangle, deepest.normal)) continue;
    for (const Vec3& point : convex.points()) {
      const Vec3 corner = convex_in_mesh * point;
      const double height = (triangle[0] - corner).dot(deepest.normal), distance = height - convex.radius();
      if (distance > threshold || !isOver(triangle, facing, corner)) continue;
      const Vec3 on_convex = corner + convex.radius() * deepest.normal;
      if ((on_convex - deepest.point_on_b).squaredNorm() < 1e-12 * facing.norm())
        continue;  // the deepest itself
      contacts.push_back({corner + height * deepest.normal, on_convex, deepest.normal, distance,
                          deepest.triangle_a, kNoTriangle});
    }
  }
}

}  // namespace octoblisk::detail
