#include "geometry/separating_axis.h"

#include <cmath>

namespace octoblisk::detail {
namespace {

/// Eq. 11, with both sides scaled by |axis|; strict by a few ulps, so that rounding never separates boxes.
bool separates(const Vec3& axis, const Obb& a, const Obb& b) {
  const double radius_a = (a.axes.transpose() * axis).cwiseAbs().dot(a.half_extents);
  const double radius_b = (b.axes.transpose() * axis).cwiseAbs().dot(b.half_extents);
  const double rounding = 1e-15 * (a.center.cwiseAbs() + b.center.cwiseAbs()).dot(axis.cwiseAbs());
  return std::abs((a.center - b.center).dot(axis)) > (radius_a + radius_b) * (1.0 + 1e-14) + rounding;
}

}  // namespace

bool overlaps(const Obb& a, const Obb& b, SeparatingAxes axes) {
  if (axes == SeparatingAxes::first_x) return !separates(a.axes.col(0), a, b);
  for (int i = 0; i < 3; ++i) {
    if (separates(a.axes.col(i), a, b) || separates(b.axes.col(i), a, b)) return false;
  }
  constexpr double kParallel =
      1e-6;  // below this |sin| the cross product is noise, and the face axes suffice
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 axis = a.axes.col(i).cross(b.axes.col(j));
      if (axis.squaredNorm() > kParallel * kParallel && separates(axis, a, b)) return false;
    }
  }
  return true;
}

}  // namespace octoblisk::detail
