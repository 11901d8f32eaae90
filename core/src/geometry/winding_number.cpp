#include "geometry/winding_number.h"

#include <complex>
#include <numbers>

namespace octoblisk::detail {
namespace {

/// A complex number whose argument is half the signed solid angle of a triangle (A. Van Oosterom, J.
/// Strackee, The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30 (2), 1983).
std::complex<double> halfSolidAngle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return {la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb, a.dot(b.cross(c))};
}

/// Whether arguments add up without a turn: both are below a right angle, and so is their sum.
bool isShortTurn(const std::complex<double>& by, const std::complex<double>& product) {
  constexpr double kLeast = 1e-150, kMax = 1e150;
  return by.real() > 0.0 && product.real() > kLeast && product.real() < kMax;
}

}  // namespace

double windingNumber(const TriangleMesh& mesh, const Vec3& point, std::uint32_t left_out) {
  // An argument costs more than a product, so it is taken only of products of many triangles.
  double sum = 0.0;
  std::complex<double> product = 1.0;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    if (t == left_out) continue;
    const Triangle triangle = mesh.triangle(t);
    const auto by = halfSolidAngle(triangle[0] - point, triangle[1] - point, triangle[2] - point);
    const std::complex<double> next{product.real() * by.real() - product.imag() * by.imag(),
                                    product.real() * by.imag() + product.imag() * by.real()};
    if (product.real() > 0.0 && isShortTurn(by, next)) {
      product = next;
    } else {
      sum += std::arg(product);
      product = by;
    }
  }
  return (sum + std::arg(product)) / (2.0 * std::numbers::pi);
}

}  // namespace octoblisk::detail
