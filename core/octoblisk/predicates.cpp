#include "octoblisk/predicates.h"

#include <cassert>
#include <cmath>

namespace octoblisk {
namespace {

constexpr double kEpsilon = 0x1p-53;                              // half an ulp of 1
constexpr double kFilter3d = (7.0 + 56.0 * kEpsilon) * kEpsilon;  // Shewchuk's o3derrboundA
constexpr double kFilter2d = (3.0 + 16.0 * kEpsilon) * kEpsilon;  // Shewchuk's ccwerrboundA

int sign(double value) { return (value > 0.0) - (value < 0.0); }

/// A sum of doubles kept without rounding, as components that do not overlap, smallest first.
template <int Capacity>
class ExactSum {
 public:
  /// Adds x·y·z exactly: four components.
  void addProduct(double x, double y, double z) {
    const double xy = x * y;
    const double xy_tail = std::fma(x, y, -xy);
    addProduct(xy, z);
    addProduct(xy_tail, z);
  }

  void addProduct(double x, double y) {
    const double product = x * y;
    add(std::fma(x, y, -product));
    add(product);
  }

  int sign() const { return count_ == 0 ? 0 : octoblisk::sign(component_[count_ - 1]); }

 private:
  // Shewchuk's Grow-Expansion with the zeros left out.
  void add(double value) {
    double sum = value;
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const double total = sum + component_[i];
      const double part = total - sum;
      const double tail = (sum - (total - part)) + (component_[i] - part);
      if (tail != 0.0) component_[kept++] = tail;
      sum = total;
    }
    if (sum != 0.0) component_[kept++] = sum;
    assert(kept <= Capacity);
    count_ = kept;
  }

  double component_[Capacity];
  int count_ = 0;
};

/// Adds factor · u·(v×w), factor = ±1.
template <typename Sum>
void addTripleProduct(Sum& sum, double factor, const Vec3& u, const Vec3& v, const Vec3& w) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum.addProduct(factor * u[i], v[j], w[k]);
    sum.addProduct(-factor * u[i], v[k], w[j]);
  }
}

int exactOrient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  ExactSum<96> sum;  // 4 triple products of 6 terms of 4 components
  addTripleProduct(sum, 1.0, b, c, d);
  addTripleProduct(sum, -1.0, a, c, d);
  addTripleProduct(sum, 1.0, a, b, d);
  addTripleProduct(sum, -1.0, a, b, c);
  return sum.sign();
}

int exactOrient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  ExactSum<12> sum;  // 6 terms of 2 components
  const auto addCross = [&](double factor, const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    sum.addProduct(factor * u.x(), v.y());
    sum.addProduct(-factor * u.y(), v.x());
  };
  addCross(1.0, b, c);
  addCross(-1.0, a, c);
  addCross(1.0, a, b);
  return sum.sign();
}

}  // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a, ac = c - a, ad = d - a;
  const double xy = ab.x() * ac.y(), yx = ab.y() * ac.x();
  const double yz = ab.y() * ac.z(), zy = ab.z() * ac.y();
  const double zx = ab.z() * ac.x(), xz = ab.x() * ac.z();
  const double determinant = ad.z() * (xy - yx) + ad.x() * (yz - zy) + ad.y() * (zx - xz);
  const double permanent = (std::abs(xy) + std::abs(yx)) * std::abs(ad.z()) +
                           (std::abs(yz) + std::abs(zy)) * std::abs(ad.x()) +
                           (std::abs(zx) + std::abs(xz)) * std::abs(ad.y());
  if (std::abs(determinant) > kFilter3d * permanent) return sign(determinant);
  return exactOrient3d(a, b, c, d);
}

int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double determinant = left - right;
  if (std::abs(determinant) > kFilter2d * (std::abs(left) + std::abs(right))) return sign(determinant);
  return exactOrient2d(a, b, c);
}

}  // namespace octoblisk
