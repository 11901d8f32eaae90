#include "octoblisk/mass_properties.h"

#include <cmath>
#include <memory>

#include "geometry/principal_axes.h"
#include "octoblisk/function_ref.h"
#include "query/simple_solid.h"
#include "query/solid_parts.h"

namespace octoblisk {

using namespace detail;

namespace {

/// (∫ |x|² dV) 1 − ∫ x xᵀ dV, from the latter.
Mat3 inertiaOf(const Mat3& second_moments) {
  return second_moments.trace() * Mat3::Identity() - second_moments;
}

MassProperties ofBox(const Aabb& box) {
  const Vec3 half = box.halfExtents();
  const Mat3 second_moments = (half.cwiseAbs2() / 3.0).asDiagonal();
  return {false, 8.0 * half.prod(), box.center(), inertiaOf(second_moments)};
}

/// Visits a triangle of a solid's boundary. Its share is negative if it faces into the solid. Where k equal
/// triangles lie on each other, each has a k-th.
using ShareVisitor = FunctionRef<void(const Triangle& triangle, double share)>;

/// Of the solid that the triangles bound.
MassProperties propertiesOf(const Aabb& bounds, FunctionRef<void(ShareVisitor visit)> forEachTriangle) {
  const double size = bounds.halfExtents().maxCoeff();
  if (!(size > 0.0)) return ofBox(bounds);

  // In units of the mesh's size from its middle, where nothing overflows and cancellation is small.
  const Vec3 middle = bounds.center();
  double volume = 0.0, outward_volume = 0.0;
  Vec3 first_moment = Vec3::Zero();
  Mat3 second_moments = Mat3::Zero();
  forEachTriangle([&](const Triangle& triangle, double share) {
    const auto& [a, b, c] = triangle;
    const Vec3 p = (a - middle) / size, q = (b - middle) / size, r = (c - middle) / size, sum = p + q + r;
    const double six_volumes = share * p.dot(q.cross(r));
    volume += six_volumes / 6.0;
    outward_volume += std::copysign(share, 1.0) * p.dot(q.cross(r)) / 6.0;
    first_moment += six_volumes / 24.0 * sum;
    second_moments += six_volumes / 120.0 *
                      (p * p.transpose() + q * q.transpose() + r * r.transpose() + sum * sum.transpose());
  });
  // Rounding gives a surface that encloses nothing a volume up to this.
  constexpr double kNoVolume = 1e-14;
  if (std::abs(volume) < kNoVolume) return ofBox(bounds);

  const Vec3 center = first_moment / volume;
  const Mat3 about_center = second_moments / volume - center * center.transpose();
  // Where the mesh only seems to bound a solid, the moments are those of no body.
  const bool is_outside = !(center.array().abs() * size <= bounds.halfExtents().array()).all();
  const Mat3 axes = principalAxes(about_center);
  const Vec3 spread = (axes.transpose() * about_center * axes).diagonal();
  constexpr double kRounding = 1e-12;
  if (is_outside || spread.minCoeff() < -kRounding * spread.maxCoeff()) return ofBox(bounds);
  return {true, std::abs(volume) * size * size * size, middle + size * center,
          inertiaOf(about_center) * (size * size), outward_volume < 0.0};
}

}  // namespace

Mat3 MassProperties::inertiaAbout(const Vec3& point) const {
  const Vec3 arm = center_of_mass - point;
  return inertia + inertiaOf(arm * arm.transpose());
}

MassProperties detail::massPropertiesOfSimple(const TriangleMesh& mesh) {
  return propertiesOf(mesh.bounds(), [&](ShareVisitor visit) {
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) visit(mesh.triangle(t), 1.0);
  });
}

MassProperties detail::massPropertiesOfBox(const TriangleMesh& mesh) { return ofBox(mesh.bounds()); }

MassProperties massProperties(const TriangleMesh& mesh) {
  if (isSimpleSolid(mesh)) return detail::massPropertiesOfSimple(mesh);
  const auto shared = std::shared_ptr<const TriangleMesh>(std::shared_ptr<void>(), &mesh);  // not owned
  const ClusteredOctree tree = ClusteredOctree::build(shared);
  return massProperties(Surface(tree));
}

MassProperties massProperties(const Surface& surface) {
  const SolidParts& parts = surface.solidParts();
  const TriangleMesh& mesh = surface.tree().mesh();
  if (!surface.isClosed()) return ofBox(mesh.bounds());
  const auto signOf = [&](std::uint32_t t) { return surface.role(t) == TriangleRole::inward ? -1.0 : 1.0; };
  return propertiesOf(mesh.bounds(), [&](ShareVisitor visit) {
    if (const BoundarySurface* boundary = parts.boundary.get()) {
      for (std::size_t t = 0; t < boundary->share.size(); ++t)
        visit(boundary->tree.mesh().triangle(t), boundary->share[t]);
    } else {
      for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) visit(mesh.triangle(t), signOf(t));
    }
    for (const Gap& gap : parts.gaps) {
      for (const Triangle& triangle : gap.cap)
        visit(triangle, gap.is_inner ? 0.0 : signOf(gap.edges[0].triangle));
    }
  });
}

PrincipalFrame principalFrame(const MassProperties& properties) {
  // A moment is the greater, the less far the body extends along its axis: moments ascend when Σ x xᵀ
  // descends.
  const Mat3 second_moments = 0.5 * properties.inertia.trace() * Mat3::Identity() - properties.inertia;
  const Mat3 axes = principalAxes(second_moments);
  return {{axes, properties.center_of_mass}, (axes.transpose() * properties.inertia * axes).diagonal()};
}

}  // namespace octoblisk
