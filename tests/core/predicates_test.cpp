#include "geometry/predicates.h"

#include <gtest/gtest.h>

#include "base/wide_product.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::randomPoint;
using testing::uniform;

__extension__ using Int128 = __int128;
__extension__ using UnsignedInt128 = unsigned __int128;

int sign(Int128 value) { return (value > 0) - (value < 0); }

/// Exact in 128-bit integers for coordinates below 2^31.
int integerOrient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto difference = [&](const Vec3& point, int k) {
    return static_cast<Int128>(point[k]) - static_cast<Int128>(a[k]);
  };
  Int128 sum = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum += difference(d, i) * (difference(b, j) * difference(c, k) - difference(b, k) * difference(c, j));
  }
  return sign(sum);
}

TEST(WideProduct, halvesEqualIntegersOf128Bits) {
  std::vector<std::uint64_t> values = {0, 1, 3, 0xffffffff, 0x100000000, 0x100000001};
  for (std::size_t i = values.size(); i-- > 0;) values.push_back(~values[i]);  // the greatest
  std::mt19937_64 random(9);
  for (int i = 0; i < 600; ++i) values.push_back(random() >> random() % 64);
  for (const std::uint64_t a : values) {
    for (const std::uint64_t b : values) {
      const auto expected = static_cast<UnsignedInt128>(a) * b;
      const WideProduct halves = productOfHalves(a, b), used = product(a, b);
      ASSERT_EQ(halves.low, static_cast<std::uint64_t>(expected)) << a << ' ' << b;
      ASSERT_EQ(halves.high, static_cast<std::uint64_t>(expected >> 64)) << a << ' ' << b;
      ASSERT_TRUE(used.low == halves.low && used.high == halves.high) << a << ' ' << b;
    }
  }
}

TEST(Predicates, orient3dEqualsIntegers) {
  std::mt19937_64 random(1);
  std::array<int, 3> seen{};
  for (int i = 0; i < 200'000; ++i) {
    const auto point = [&] { return Vec3(randomPoint(random, 1 << 30).array().round()); };
    const Vec3 a = point(), b = point(), c = point();
    Vec3 d = point();
    if (i % 4 !=
        0) {  // in the plane of a, b, c up to rounding: the filter gives up and the exact sum decides
      const double u = uniform(random, -1, 1), v = uniform(random, -1, 1);
      d = (a + u * (b - a) + v * (c - a)).array().round();
      if (i % 4 == 1) d = 2.0 * b - a;  // on the line through a and b: exactly 0
    }
    const int expected = integerOrient3d(a, b, c, d);
    ++seen[static_cast<std::size_t>(expected + 1)];
    ASSERT_EQ(orient3d(a, b, c, d), expected) << "case " << i;
  }
  for (const int count : seen) EXPECT_GT(count, 20'000);
}

TEST(Predicates, orient3dDecidesTheLastBit) {
  // Points of the plane x + y + z = 0 moved by one unit in the last place.
  const Vec3 a(0.1, 0.2, -(0.1 + 0.2)), b(0.5, -0.25, -0.25), c(-0.75, 0.5, 0.25);
  const Vec3 d = a + (b - a) * 0.0;
  EXPECT_EQ(orient3d(a, b, c, d), 0);
  const int up = orient3d(a, b, c, {d.x(), d.y(), std::nextafter(d.z(), 1.0)});
  const int down = orient3d(a, b, c, {d.x(), d.y(), std::nextafter(d.z(), -1.0)});
  EXPECT_EQ(up * down, -1);
}

TEST(Predicates, orient3dChangesSignWithEverySwap) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 a = randomPoint(random, 1), b = randomPoint(random, 1);
    const Vec3 c = a + (b - a) * uniform(random, -1, 1);  // nearly collinear, so rarely decided by the filter
    const Vec3 d = randomPoint(random, 1);
    const int side = orient3d(a, b, c, d);
    ASSERT_EQ(orient3d(b, a, c, d), -side);
    ASSERT_EQ(orient3d(a, c, b, d), -side);
    ASSERT_EQ(orient3d(d, b, c, a), -side);
    ASSERT_EQ(orient3d(b, c, a, d), side);
  }
}

TEST(Predicates, exactAtEveryScale) {
  // Scaling every corner by a power of two, down to denormals, keeps integer determinants exact.
  std::mt19937_64 random(4);
  std::array<int, 3> seen{};
  for (int i = 0; i < 200'000; ++i) {
    const double size = i % 2 ? 2.0 : 1000.0;
    const auto point = [&] { return Vec3(randomPoint(random, size).array().round()); };
    const Vec3 a = point(), b = point(), c = point();
    const Vec3 d = i % 3 ? point() : Vec3(a + (b - a) + (c - a));
    const int expected = integerOrient3d(a, b, c, d);
    ++seen[static_cast<std::size_t>(expected + 1)];
    const double scale = std::ldexp(1.0, static_cast<int>(uniform(random, -1074, 1013)));
    ASSERT_EQ(orient3d(scale * a, scale * b, scale * c, scale * d), expected) << "scale " << scale;
    const int flat = sign(static_cast<Int128>((b - a).x()) * static_cast<Int128>((c - a).y()) -
                          static_cast<Int128>((b - a).y()) * static_cast<Int128>((c - a).x()));
    ASSERT_EQ(orient2d(scale * a.head<2>(), scale * b.head<2>(), scale * c.head<2>()), flat);
    // Scaling a single axis moves no point across the plane.
    const Vec3 one_axis(1.0, std::ldexp(1.0, i % 1000 - 1000), 1.0);
    const auto squeezed = [&](const Vec3& p) { return Vec3(p.cwiseProduct(one_axis)); };
    ASSERT_EQ(orient3d(squeezed(a), squeezed(b), squeezed(c), squeezed(d)), expected) << one_axis.y();
  }
  for (const int count : seen) EXPECT_GT(count, 20'000);
}

TEST(Predicates, orient2dEqualsIntegers) {
  std::mt19937_64 random(3);
  int collinear = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto point = [&] {
      return Eigen::Vector2d(randomPoint(random, 1 << 30).head<2>().array().round());
    };
    const Eigen::Vector2d a = point(), b = point();
    Eigen::Vector2d c = point();
    if (i % 2 == 0) c = (a + uniform(random, -1, 1) * (b - a)).array().round();
    if (i % 8 == 0) c = 2.0 * b - a;
    const auto d = [&](const Eigen::Vector2d& p, int k) {
      return static_cast<Int128>(p[k]) - static_cast<Int128>(a[k]);
    };
    const int expected = sign(d(b, 0) * d(c, 1) - d(b, 1) * d(c, 0));
    collinear += expected == 0;
    ASSERT_EQ(orient2d(a, b, c), expected) << "case " << i;
  }
  EXPECT_GT(collinear, 10'000);
}

}  // namespace
}  // namespace octoblisk
