#include "octoblisk/mass_properties.h"

#include <cmath>

#include "geometry/oriented_closed.h"
#include "geometry/principal_axes.h"

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

}  // namespace

Mat3 MassProperties::inertiaAbout(const Vec3& point) const {
  const Vec3 arm = center_of_mass - point;
  return inertia + inertiaOf(arm * arm.transpose());
}

MassProperties massProperties(const TriangleMesh& mesh) {
  const Aabb& bounds = mesh.bounds();
  const double size = bounds.halfExtents().maxCoeff();
  if (!(size > 0.0) || !isOrientedClosed(mesh)) return ofBox(bounds);

  // In units of the mesh's size from its middle, where nothing overflows and cancellation is small.
  const Vec3 middle = bounds.center();
  double volume = 0.0;
  Vec3 first_moment = Vec3::Zero();
  Mat3 second_moments = Mat3::Zero();
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto [a, b, c] = mesh.triangle(t);
    const Vec3 p = (a - middle) / size, q = (b - middle) / size, r = (c - middle) / size, sum = p + q + r;
    const double six_volumes = p.dot(q.cross(r));
    volume += six_volumes / 6.0;
    first_moment += six_volumes / 24.0 * sum;
    second_moments += six_volumes / 120.0 *
                      (p * p.transpose() + q * q.transpose() + r * r.transpose() + sum * sum.transpose());
  }
  // Rounding gives a surface that encloses nothing a volume up to this.
  constexpr double kNoVolume = 1e-14;
  if (std::abs(volume) < kNoVolume) return ofBox(bounds);

  const Vec3 center = first_moment / volume;  // signs cancel if the mesh faces inward
  const Mat3 about_center = second_moments / volume - center * center.transpose();
  // A part that faces inward as a whole counts as negative.
  const bool is_outside = !(center.array().abs() * size <= bounds.halfExtents().array()).all();
  const Mat3 axes = principalAxes(about_center);
  const Vec3 spread = (axes.transpose() * about_center * axes).diagonal();
  constexpr double kRounding = 1e-12;
  if (is_outside || spread.minCoeff() < -kRounding * spread.maxCoeff()) return ofBox(bounds);
  return {true, std::abs(volume) * size * size * size, middle + size * center,
          inertiaOf(about_center) * (size * size), volume < 0.0};
}

PrincipalFrame principalFrame(const MassProperties& properties) {
  // A moment is the greater, the less far the body extends along its axis: moments ascend when Σ x xᵀ
  // descends.
  const Mat3 second_moments = 0.5 * properties.inertia.trace() * Mat3::Identity() - properties.inertia;
  const Mat3 axes = principalAxes(second_moments);
  return {{axes, properties.center_of_mass}, (axes.transpose() * properties.inertia * axes).diagonal()};
}

}  // namespace octoblisk
