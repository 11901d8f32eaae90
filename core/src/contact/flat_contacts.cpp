#include "contact/flat_contacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/polygon.h"

namespace octoblisk::detail {
namespace {

constexpr double kNearlyAlong = 0.98;  // the cosine of 11°

using FlatPolygon = Polygon<3 + HullFaceList::kMaxPoints>;

bool isOf(const HullEdge& edge, std::size_t face) { return edge.left == face || edge.right == face; }

/// The face whose normal is nearest to a unit vector, and the cosine between them.
std::pair<std::size_t, double> faceAlong(const HullFaces& hull, const Vec3& direction) {
  std::pair<std::size_t, double> best(0, -2.0);
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const double along = hull.faces[f].normal.dot(direction);
    if (along > best.second) best = {f, along};
  }
  return best;
}

/// Cuts off everything that is not over or under a face of the hull.
void cutToFace(FlatPolygon& polygon, std::size_t face, const HullFaces& hull, std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  double ends = 0.0;
  for (const HullEdge& edge : hull.edges) {
    if (!isOf(edge, face)) continue;
    sum += points[edge.from] + points[edge.to];
    ends += 2.0;
  }
  const Vec3 middle = sum / ends;
  for (const HullEdge& edge : hull.edges) {
    if (!isOf(edge, face)) continue;
    Vec3 outward = (points[edge.to] - points[edge.from]).cross(hull.faces[face].normal);
    if (outward.dot(middle - points[edge.from]) > 0.0) outward = -outward;
    const double offset = outward.dot(points[edge.from]);
    polygon.cut([&](const Vec3& point) { return offset - outward.dot(point); });
  }
}

}  // namespace

void addFlatContacts(const TriangleMesh& mesh, const Convex& convex, const Pose& convex_in_mesh,
                     double threshold, std::vector<Contact>& contacts) {
  const std::size_t of_triangles = contacts.size();
  if (of_triangles == 0) return;
  const HullFaces hull = convex.faces();
  if (hull.empty()) return;
  const Pose mesh_in_convex = convex_in_mesh.inverse();
  for (std::size_t c = 0; c < of_triangles; ++c) {
    const Contact of_triangle = contacts[c];
    const Triangle triangle = mesh.triangle(of_triangle.triangle_a);
    const Vec3 facing = scaledNormal(triangle);
    Vec3 normal_in_mesh = facing.normalized();
    const double along_contact = normal_in_mesh.dot(of_triangle.normal);
    if (!(std::abs(along_contact) > kNearlyAlong)) continue;
    if (along_contact < 0.0) normal_in_mesh = -normal_in_mesh;
    const Vec3 normal = mesh_in_convex.rotation * normal_in_mesh;
    const auto [number, along] = faceAlong(hull, normal);
    if (!(along > kNearlyAlong)) continue;
    const HullFace& face = hull.faces[number];
    const Triangle triangle_in_convex = mesh_in_convex * triangle;
    FlatPolygon shared(triangle_in_convex);
    cutToFace(shared, number, hull, convex.points());
    for (const Vec3& corner : shared.corners()) {
      // A corner of the triangle is pushed by the face; elsewhere the triangle pushes.
      const bool is_of_triangle = std::ranges::find(triangle_in_convex, corner) != triangle_in_convex.end();
      const Vec3 on_triangle = convex_in_mesh * corner;
      if (is_of_triangle && (on_triangle - of_triangle.point_on_a).squaredNorm() < 1e-12 * facing.norm())
        continue;  // the contact itself
      const double height = face.normal.dot(corner) - face.offset;
      double distance = (is_of_triangle ? height : height / along) - convex.radius();
      if (distance > threshold) continue;
      Vec3 out = is_of_triangle ? Vec3(convex_in_mesh.rotation * face.normal) : normal_in_mesh;
      if (distance < of_triangle.distance) {  // slightly askew: farther in than the shortest way out
        distance = of_triangle.distance;
        out = of_triangle.normal;
      }
      contacts.push_back(
          {on_triangle, on_triangle - distance * out, out, distance, of_triangle.triangle_a, kNoTriangle});
    }
  }
}

}  // namespace octoblisk::detail
