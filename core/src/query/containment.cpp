#include "octoblisk/containment.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/thin_triangle.h"
#include "geometry/triangle_feature.h"
#include "octoblisk/collide.h"
#include "query/solid_parts.h"
#include "query/touching_distance.h"

namespace octoblisk {

using namespace detail;

namespace {

/// The numbers of components of one solid's boundary inside and outside the other solid.
struct ComponentCount {
  std::size_t inside = 0, outside = 0;
};

ComponentCount countComponents(const Surface& of, const Pose& of_in_a, const Surface& in,
                               const Pose& in_in_a) {
  ComponentCount count;
  for (std::size_t component = 0; component < of.componentCount(); ++component) {
    const Vec3 point = of_in_a * of.position(of.cornerOfComponent(component));
    ++(locate(in, point, in_in_a) == PointLocation::inside ? count.inside : count.outside);
  }
  return count;
}

double angleAt(const Triangle& triangle, std::size_t corner) {
  const Vec3 to_next = triangle[(corner + 1) % 3] - triangle[corner];
  const Vec3 to_last = triangle[(corner + 2) % 3] - triangle[corner];
  return std::atan2(to_next.cross(to_last).norm(), to_next.dot(to_last));
}

/// The pseudonormal of the feature (face, edge or vertex) of a whole surface that the point lies on; none if
/// a triangle there is too thin for its normal, for example one that fills a T-junction.
std::optional<Vec3> pseudonormal(const Surface& surface, const ClosestPoint& at) {
  const TriangleMesh& mesh = surface.tree().mesh();
  const Triangle triangle = mesh.triangle(at.triangle);
  if (isThin(triangle)) return std::nullopt;
  const auto& corners = surface.corners(at.triangle);
  constexpr double kOnEdge = 1e-9;  // fraction of the triangle's height
  const unsigned feature = featureOf(triangle, scaledNormal(triangle), at.point, kOnEdge);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    Vec3 sum = Vec3::Zero();
    if (feature == (1u << i | 1u << next)) {
      for (const std::uint32_t t : surface.star(corners[i])) {
        if (std::ranges::find(surface.corners(t), corners[next]) == surface.corners(t).end()) continue;
        if (isThin(mesh.triangle(t))) return std::nullopt;
        sum += unitNormal(mesh.triangle(t));
      }
      return sum;
    }
    if (feature != 1u << i) continue;
    for (const std::uint32_t t : surface.star(corners[i])) {
      const auto& of_t = surface.corners(t);
      const auto corner = static_cast<std::size_t>(std::ranges::find(of_t, corners[i]) - of_t.begin());
      const Triangle beside = mesh.triangle(t);
      if (isThin(beside)) return std::nullopt;
      sum += angleAt(beside, corner) * unitNormal(beside);
    }
    return sum;
  }
  return unitNormal(triangle);
}

/// Where a point of the mesh is. It is inside if the boundary of the solid is elsewhere.
PointLocation locateOnMesh(const Surface& surface, const Vec3& point) {
  if (&surface.boundary() == &surface.tree()) return PointLocation::on_surface;
  // Corners of the boundary where triangles intersect are rounded.
  const double rounding = 4.0 * touchingDistance(surface.tree().mesh());
  const double distance = closestPoint(surface.boundary(), point)->distance;
  if (distance <= rounding) return PointLocation::on_surface;
  // All points nearby are on the same side of the boundary. Some are on no triangle.
  for (double step = distance / 2.0; step > distance / 64.0; step *= 0.7) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 beside = point + (k < 3 ? step : -step) * Vec3::Unit(k % 3);
      const std::optional<int> winding = surface.solidParts().winding.at(beside);
      if (winding) return *winding != 0 ? PointLocation::inside : PointLocation::outside;
    }
  }
  return PointLocation::inside;
}

}  // namespace

PointLocation locate(const Surface& surface, const Vec3& point, const Pose& surface_in_a) {
  const std::optional<int> winding = surface.solidParts().winding.at(point, surface_in_a);
  if (!winding) return locateOnMesh(surface, surface_in_a.inverse() * point);
  return *winding != 0 ? PointLocation::inside : PointLocation::outside;
}

PointLocation locate(const Surface& surface, const Vec3& point, const ClosestPoint& nearest) {
  if (!surface.isWhole() || nearest.distance == 0.0 ||
      surface.role(nearest.triangle) != TriangleRole::outward)
    return locate(surface, point);
  const std::optional<Vec3> normal = pseudonormal(surface, nearest);
  if (!normal) return locate(surface, point);
  return normal->dot(point - nearest.point) < 0.0 ? PointLocation::inside : PointLocation::outside;
}

double windingNumber(const Surface& surface, const Vec3& point) {
  return surface.solidParts().winding.valueAt(point);
}

Containment containment(const Surface& a, const Surface& b, const Pose& b_in_a) {
  // What touches only inside a solid does not touch its boundary.
  const bool have_inner = &a.boundary() != &a.tree() || &b.boundary() != &b.tree();
  if (collide(a.tree(), b.tree(), b_in_a) && (!have_inner || collide(a.boundary(), b.boundary(), b_in_a)))
    return Containment::touching;
  if (!a.isClosed() || !b.isClosed()) return Containment::unknown;
  // Each component of a surface is now wholly inside or outside the other solid. Where A and B share a point,
  // the shared region is bounded by a component of A's surface in B or one of B's in A; likewise for the
  // region of B that is not in A.
  const Pose identity;
  const ComponentCount of_a = countComponents(boundaryOf(a), identity, b, b_in_a),
                       of_b = countComponents(boundaryOf(b), b_in_a, a, identity);
  if (of_a.inside == 0 && of_b.inside == 0) return Containment::apart;
  if (of_a.inside == 0 && of_b.outside == 0) return Containment::b_inside_a;
  if (of_b.inside == 0 && of_a.outside == 0) return Containment::a_inside_b;
  return Containment::overlapping;
}

}  // namespace octoblisk
