#include "geometry/predicates.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "base/wide_product.h"

namespace octoblisk::detail {
namespace {

constexpr double kEpsilon = 0x1p-53;                              // half an ulp of 1
constexpr double kFilter3d = (7.0 + 56.0 * kEpsilon) * kEpsilon;  // Shewchuk's o3derrboundA
constexpr double kFilter2d = (3.0 + 16.0 * kEpsilon) * kEpsilon;  // Shewchuk's ccwerrboundA

/// Exceeds everything that underflow may add to a determinant of differences up to 1e15. If products
/// overflow, the filter does not decide.
constexpr double kUnderflow = 1e-300;

int sign(double value) { return (value > 0.0) - (value < 0.0); }

/// A sum of products of doubles as integers: exact for all finite doubles, including subnormal ones.
class ExactSum {
 public:
  /// Adds x·y·z.
  void add(double x, double y, double z) {
    if (x == 0.0 || y == 0.0 || z == 0.0) return;
    const Parts px = partsOf(x), py = partsOf(y), pz = partsOf(z);
    const WideProduct xy = product(px.mantissa, py.mantissa);
    const WideProduct low = product(xy.low, pz.mantissa), high = product(xy.high, pz.mantissa);
    std::array<Word, 3> words = {low.low, high.low, high.high};
    words[2] += addTo(words[1], low.high);
    const int exponent = px.exponent + py.exponent + pz.exponent - kLowest;
    addShifted(words, exponent, (px.negative != py.negative) != pz.negative ? negative_ : positive_);
  }

  int sign() const {
    for (std::size_t w = kWords; w-- > 0;) {
      if (positive_[w] != negative_[w]) return positive_[w] > negative_[w] ? 1 : -1;
    }
    return 0;
  }

 private:
  using Word = std::uint64_t;
  static constexpr int kLowest = -3 * 1074;  // the exponent of the last bit: the least double, cubed
  static constexpr std::size_t kWords = 99;  // 3·1074 + 3·1024 bits, and 5 for the sum of 24 terms
  using Words = std::array<Word, kWords>;

  /// ±mantissa · 2^exponent, exactly.
  struct Parts {
    Word mantissa;
    int exponent;
    bool negative;
  };

  static Parts partsOf(double value) {
    const Word bits = std::bit_cast<Word>(value);
    const Word fraction = bits & ((Word{1} << 52) - 1);
    const int biased = static_cast<int>(bits >> 52) & 0x7ff;
    const bool normal = biased != 0;
    return {normal ? fraction | Word{1} << 52 : fraction, (normal ? biased : 1) - 1075, (bits >> 63) != 0};
  }

  /// Returns the carry.
  static Word addTo(Word& word, Word addend) {
    word += addend;
    return word < addend ? 1 : 0;
  }

  static void addShifted(const std::array<Word, 3>& words, int shift, Words& sum) {
    auto word = static_cast<std::size_t>(shift / 64);
    const int bit = shift % 64;
    Word carry = 0;
    Word spill = 0;  // from the product's previous word
    for (const Word part : words) {
      const Word carried = addTo(sum[word], (part << bit) | spill);
      spill = bit == 0 ? 0 : part >> (64 - bit);
      carry = carried + addTo(sum[word++], carry);
    }
    carry = addTo(sum[word], spill) + addTo(sum[word], carry);
    while (carry != 0) {
      assert(word + 1 < kWords);
      carry = addTo(sum[++word], carry);
    }
  }

  Words positive_{};
  Words negative_{};
};

/// Adds factor · u·(v×w), factor = ±1.
void addTripleProduct(ExactSum& sum, double factor, const Vec3& u, const Vec3& v, const Vec3& w) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum.add(factor * u[i], v[j], w[k]);
    sum.add(-factor * u[i], v[k], w[j]);
  }
}

int exactOrient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  ExactSum sum;
  addTripleProduct(sum, 1.0, b, c, d);
  addTripleProduct(sum, -1.0, a, c, d);
  addTripleProduct(sum, 1.0, a, b, d);
  addTripleProduct(sum, -1.0, a, b, c);
  return sum.sign();
}

int exactSideOfLine(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b) {
  ExactSum sum;
  addTripleProduct(sum, 1.0, direction, a, b);
  addTripleProduct(sum, -1.0, direction, a, origin);
  addTripleProduct(sum, -1.0, direction, origin, b);
  return sum.sign();
}

int exactOrient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  ExactSum sum;
  const auto addCross = [&](double factor, const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    sum.add(factor, u.x(), v.y());
    sum.add(-factor, u.y(), v.x());
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
  if (std::abs(determinant) > kFilter3d * permanent + kUnderflow) return sign(determinant);
  return exactOrient3d(a, b, c, d);
}

int sideOfLine(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b) {
  const Vec3 oa = a - origin, ob = b - origin;
  const double xy = oa.x() * ob.y(), yx = oa.y() * ob.x();
  const double yz = oa.y() * ob.z(), zy = oa.z() * ob.y();
  const double zx = oa.z() * ob.x(), xz = oa.x() * ob.z();
  const double determinant =
      direction.z() * (xy - yx) + direction.x() * (yz - zy) + direction.y() * (zx - xz);
  const double permanent = (std::abs(xy) + std::abs(yx)) * std::abs(direction.z()) +
                           (std::abs(yz) + std::abs(zy)) * std::abs(direction.x()) +
                           (std::abs(zx) + std::abs(xz)) * std::abs(direction.y());
  if (std::abs(determinant) > kFilter3d * permanent + kUnderflow) return sign(determinant);
  return exactSideOfLine(origin, direction, a, b);
}

int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double determinant = left - right;
  if (std::abs(determinant) > kFilter2d * (std::abs(left) + std::abs(right)) + kUnderflow)
    return sign(determinant);
  return exactOrient2d(a, b, c);
}

}  // namespace octoblisk::detail
