#include "geometry/winding_number.h"

#include <cmath>
#include <numbers>

namespace octoblisk::detail {
namespace {

/// The signed solid angle of a triangle (A. Van Oosterom, J. Strackee, The solid angle of a plane triangle,
/// IEEE Trans. Biomed. Eng. 30 (2), 1983).
double solidAngle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

double windingNumber(const TriangleMesh& mesh, const Vec3& point, std::uint32_t left_out) {
  double sum = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    if (t == left_out) continue;
    const Triangle triangle = mesh.triangle(t);
    sum += solidAngle(triangle[0] - point, triangle[1] - point, triangle[2] - point);
  }
  return sum / (4.0 * std::numbers::pi);
}

}  // namespace octoblisk::detail
