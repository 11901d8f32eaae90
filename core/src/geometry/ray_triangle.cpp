#include "geometry/ray_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/double_double.h"
#include "geometry/predicates.h"

namespace octoblisk::detail {
namespace {

constexpr double kRelativeError = 4e-10;  // of t's numerator and denominator

using PreciseVec3 = std::array<DoubleDouble, 3>;

PreciseVec3 difference(const Vec3& a, const Vec3& b) {
  return {DoubleDouble::difference(a.x(), b.x()), DoubleDouble::difference(a.y(), b.y()),
          DoubleDouble::difference(a.z(), b.z())};
}

PreciseVec3 cross(const PreciseVec3& a, const PreciseVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

DoubleDouble dot(const PreciseVec3& a, const PreciseVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// t if doubles are not precise enough: the line is nearly in the triangle's plane.
double preciseT(const Vec3& origin, const Vec3& direction, const Triangle& triangle) {
  const PreciseVec3 normal =
      cross(difference(triangle[1], triangle[0]), difference(triangle[2], triangle[0]));
  const double height = dot(difference(triangle[0], origin), normal).rounded();
  const double rate = dot(difference(direction, Vec3::Zero()), normal).rounded();
  // Even if that is not precise enough, the error of t is limited to the triangle's extent.
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Vec3& corner : triangle) {
    const double t = (corner - origin).dot(direction) / direction.squaredNorm();
    least = std::min(least, t);
    greatest = std::max(greatest, t);
  }
  const double t = height / rate;
  return t >= least ? std::min(t, greatest) : least;
}

/// A triple product in doubles and the sum of its terms' magnitudes.
struct TripleProduct {
  double value, magnitude;

  bool isPrecise(double relative_error) const {
    constexpr double kRounding = 8 * 0x1p-53;  // of the magnitude: Shewchuk's bound, rounded up
    return kRounding * magnitude < relative_error * std::abs(value);
  }
};

/// Verdicts that doubles decide with certainty, with one bound for all rounding. These are by far the most
/// cases, and the answers equal those of the slower method to the last bit.
enum class Verdict { missed, crossed, open };

Verdict quickly(const Vec3& origin, const Vec3& direction, const Triangle& triangle, LineCrossing& found) {
  constexpr double kRounding =
      16 * 0x1p-53;  // relative to the sum of a triple product's terms: twice Shewchuk's bound
  constexpr double kProductUnderflow = 1e-300;
  const Vec3 a = triangle[0] - origin, b = triangle[1] - origin, c = triangle[2] - origin;
  const double way = direction.cwiseAbs().sum();
  const double reach = a.cwiseAbs().cwiseMax(b.cwiseAbs()).cwiseMax(c.cwiseAbs()).maxCoeff();
  const double side_error = kRounding * 2.0 * reach * reach * way + kProductUnderflow;
  const Vec3 turned_a = direction.cross(a), turned_b = direction.cross(b);
  const double ab = turned_a.dot(b), bc = turned_b.dot(c), ca = -turned_a.dot(c);
  const double least = std::min({ab, bc, ca}), greatest = std::max({ab, bc, ca});
  if (least < -side_error && greatest > side_error) return Verdict::missed;
  if (!(least > side_error || greatest < -side_error)) return Verdict::open;

  const Vec3 to_b = triangle[1] - triangle[0], to_c = triangle[2] - triangle[0];
  const Vec3 normal = to_b.cross(to_c);
  const double size = to_b.cwiseAbs().cwiseMax(to_c.cwiseAbs()).maxCoeff();
  const double height = a.dot(normal), rate = direction.dot(normal);
  const double error = kRounding / kRelativeError * 2.0 * size * size;
  if (!(std::abs(height) > error * 3.0 * reach + kProductUnderflow &&
        std::abs(rate) > error * way + kProductUnderflow)) {
    return Verdict::open;
  }
  if ((height > 0.0) != (rate > 0.0)) return Verdict::missed;
  found = {height / rate, rate > 0.0};
  return Verdict::crossed;
}

}  // namespace

std::optional<LineCrossing> crossing(const Vec3& origin, const Vec3& direction, const Triangle& triangle) {
  LineCrossing found;
  const Verdict verdict = quickly(origin, direction, triangle, found);
  if (verdict == Verdict::missed) return std::nullopt;
  if (verdict == Verdict::crossed) return found;
  const auto& [a, b, c] = triangle;
  int positive = 0, negative = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = sideOfLine(origin, direction, triangle[i], triangle[(i + 1) % 3]);
    positive += side > 0;
    negative += side < 0;
    if (positive != 0 && negative != 0) return std::nullopt;
  }
  if (positive == 0 && negative == 0) return std::nullopt;  // coplanar, or no area
  const int rate_sign = positive != 0 ? 1 : -1;             // of direction · normal

  const Vec3 ab = b - a, ac = c - a, oa = a - origin;
  const Vec3 normal = ab.cross(ac);
  const Vec3 magnitude(std::abs(ab.y() * ac.z()) + std::abs(ab.z() * ac.y()),
                       std::abs(ab.z() * ac.x()) + std::abs(ab.x() * ac.z()),
                       std::abs(ab.x() * ac.y()) + std::abs(ab.y() * ac.x()));
  const TripleProduct height{oa.dot(normal), oa.cwiseAbs().dot(magnitude)};
  const TripleProduct rate{direction.dot(normal), direction.cwiseAbs().dot(magnitude)};

  const int height_sign = height.isPrecise(1.0) ? (height.value > 0.0 ? 1 : -1) : -orient3d(a, b, c, origin);
  if (height_sign == 0) return LineCrossing{0.0, rate_sign > 0};
  if (height_sign != rate_sign) return std::nullopt;
  const bool precise = height.isPrecise(kRelativeError) && rate.isPrecise(kRelativeError);
  const double t = precise ? height.value / rate.value : preciseT(origin, direction, triangle);
  return LineCrossing{std::max(t, 0.0), rate_sign > 0};
}

}  // namespace octoblisk::detail
