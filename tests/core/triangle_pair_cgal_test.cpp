// Compares tests of two triangles with CGAL's exact kernels.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/squared_distance_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>

#include "geometry/triangle_pair.h"
#include "shared/cgal_shapes.h"
#include "shared/meshes.h"
#include "shared/triangle_pairs.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::kPairKinds;
using testing::PairKind;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kScale = 20;  // fewer cases under a sanitizer
#else
constexpr int kScale = 1;
#endif

using testing::exactlyMeet;
using testing::shapeOf;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

std::string describe(const Triangle& a, const Triangle& b) {
  std::ostringstream text;
  text << std::hexfloat;
  for (const Triangle* t : {&a, &b}) {
    for (const Vec3& corner : *t) text << corner.x() << ' ' << corner.y() << ' ' << corner.z() << '\n';
  }
  return text.str();
}

TEST(TrianglePairCgal, intersects_vs_exactKernel) {
  constexpr int kCases = 1'000'000 / kScale;
  std::mt19937_64 random(101);
  std::array<int, kPairKinds> hits{}, cases{};
  for (int i = 0; i < kCases; ++i) {
    const auto pair = testing::hardPair(random, static_cast<PairKind>(i % kPairKinds));
    const bool expected = exactlyMeet(pair.a, pair.b);
    const auto kind = static_cast<std::size_t>(pair.kind);
    ++cases[kind];
    hits[kind] += expected;
    ASSERT_EQ(intersects(pair.a, pair.b), expected) << testing::nameOf(pair.kind) << ", case " << i << '\n'
                                                    << describe(pair.a, pair.b);
  }
  int all = 0;
  for (std::size_t kind = 0; kind < kPairKinds; ++kind) {
    const char* name = testing::nameOf(static_cast<PairKind>(kind));
    RecordProperty(name, 100 * hits[kind] / cases[kind]);
    all += hits[kind];
    EXPECT_GE(hits[kind], cases[kind] * 3 / 10) << name;
    EXPECT_LE(hits[kind], cases[kind] * 7 / 10) << name;
  }
  EXPECT_GE(all, kCases * 3 / 10);
  EXPECT_LE(all, kCases * 7 / 10);
}

/// The squared distance. Empty for pairs of shapes for which CGAL has no distance.
std::optional<double> squaredDistance(const Triangle& a, const Triangle& b) {
  return std::visit(
      [](const auto& in_a, const auto& in_b) -> std::optional<double> {
        constexpr bool known = std::is_same_v<decltype(in_a), decltype(in_b)>;
        if constexpr (known) {
          return CGAL::to_double(CGAL::exact(CGAL::squared_distance(in_a, in_b)));
        } else {
          return std::nullopt;
        }
      },
      shapeOf<Exact>(a), shapeOf<Exact>(b));
}

TEST(TrianglePairCgal, closestPoints_vs_exactKernel) {
  std::mt19937_64 random(102);
  int compared = 0;
  for (int i = 0; i < 100'000 / kScale; ++i) {
    const auto [a, b, kind] = testing::hardPairOfUnitSize(random, static_cast<PairKind>(i % kPairKinds));
    if (intersects(a, b)) continue;
    const std::optional<double> squared = squaredDistance(a, b);
    if (!squared) continue;
    ++compared;
    const Contact contact = closestPoints(a, b);
    const double expected = std::sqrt(*squared);
    // Relative to the triangles' size of about 1. At this scale the coordinates themselves are rounded.
    ASSERT_NEAR(contact.distance, expected, 1e-13 + 1e-14 * expected)
        << testing::nameOf(kind) << ", case " << i << '\n'
        << describe(a, b);
    ASSERT_NEAR((contact.point_on_a - contact.point_on_b).norm(), contact.distance, 1e-14);
    ASSERT_NEAR(contact.normal.norm(), 1.0, 1e-14);
    ASSERT_GT(contactOf(a, b).distance, 0.0);
  }
}

/// Two triangles with edges that pass each other 1e-9 to 1e-3 apart, crossed or nearly parallel.
std::array<Triangle, 2> closeEdges(std::mt19937_64& random, bool parallel) {
  const auto uniform = [&](double low, double high) { return testing::uniform(random, low, high); };
  const double apart = std::pow(10.0, uniform(-9.0, -3.0));
  const double angle = parallel ? std::pow(10.0, uniform(-12.0, -2.0)) : uniform(0.1, 1.5);
  const Vec3 along(std::cos(angle), std::sin(angle), 0.0), up(0.0, 0.0, apart);
  const auto third = [&](double side) {
    return Vec3(uniform(-1.0, 1.0), uniform(-1.0, 1.0), side * std::pow(10.0, uniform(-5.0, 0.0)));
  };
  const double middle_a = uniform(-0.5, 0.5), middle_b = uniform(-0.5, 0.5);
  return {Triangle{Vec3(middle_a - 0.5, 0, 0), Vec3(middle_a + 0.5, 0, 0), third(-1.0)},
          Triangle{Vec3((middle_b - 0.5) * along + up), Vec3((middle_b + 0.5) * along + up),
                   Vec3(third(1.0) + up)}};
}

TEST(TrianglePairCgal, closestPointsOfCloseEdgesFarFromTheOrigin_vs_exactKernel) {
  std::mt19937_64 random(104);
  int compared = 0;
  for (int i = 0; i < 20'000 / kScale; ++i) {
    std::array<Triangle, 2> pair = closeEdges(random, i % 2 == 0);
    const Mat3 rotation = testing::randomRotation(random);
    const Vec3 offset = testing::randomPoint(random, std::array{0.0, 10.0, 1e3, 1e6}[i / 2 % 4]);
    for (Triangle& t : pair) {
      for (Vec3& corner : t) corner = rotation * corner + offset;
    }
    const auto& [a, b] = pair;
    if (intersects(a, b)) continue;  // moved by rounding far from the origin
    const std::optional<double> squared = squaredDistance(a, b);
    ASSERT_TRUE(squared);
    ++compared;
    ASSERT_NEAR(closestPoints(a, b).distance, std::sqrt(*squared), 1e-14) << i << '\n' << describe(a, b);
    ASSERT_NEAR(closestPoints(b, a).distance, std::sqrt(*squared), 1e-14) << i << '\n' << describe(a, b);
  }
  EXPECT_GT(compared, 18'000 / kScale);
}

/// A triangle of unit size, 1e-4 to 1e-12 wide.
Triangle sliver(std::mt19937_64& random) {
  const Triangle wide = testing::randomTriangle(random, 1.0);
  const double width = std::pow(10.0, testing::uniform(random, -12.0, -4.0));
  const Vec3 on_edge = wide[0] + testing::uniform(random, 0.1, 0.9) * (wide[1] - wide[0]);
  return {wide[0], wide[1], on_edge + width * (wide[2] - on_edge).normalized()};
}

/// A triangle with a corner that is about `distance` from a point of another one.
Triangle near(std::mt19937_64& random, const Triangle& other, double distance) {
  const double u = testing::uniform(random, 0.1, 0.5), v = testing::uniform(random, 0.1, 0.4);
  const Vec3 on_other = other[0] + u * (other[1] - other[0]) + v * (other[2] - other[0]);
  const Vec3 away = testing::randomPoint(random, 1.0);
  return {on_other + distance * away, on_other + away + testing::randomPoint(random, 0.3),
          on_other + away + testing::randomPoint(random, 0.3)};
}

TEST(TrianglePairCgal, closestPointsOfSlivers_vs_exactKernel) {
  std::mt19937_64 random(105);
  int compared = 0;
  for (int i = 0; i < 10'000 / kScale; ++i) {
    const Triangle thin = sliver(random);
    const Triangle other = near(random, thin, std::pow(10.0, testing::uniform(random, -9.0, 0.0)));
    if (intersects(thin, other)) continue;
    const std::optional<double> squared = squaredDistance(thin, other);
    if (!squared) continue;
    ++compared;
    ASSERT_NEAR(closestPoints(thin, other).distance, std::sqrt(*squared), 1e-10) << describe(thin, other);
    ASSERT_NEAR(closestPoints(other, thin).distance, std::sqrt(*squared), 1e-10) << describe(thin, other);
  }
  EXPECT_GT(compared, 9'000 / kScale);
}

using Vector = Exact::Vector_3;
using Corners = std::array<Vector, 3>;

Corners cornersOf(const Triangle& t) {
  Corners corner;
  for (std::size_t i = 0; i < 3; ++i) corner[i] = Vector(t[i].x(), t[i].y(), t[i].z());
  return corner;
}

Vector normalOf(const Corners& t) { return CGAL::cross_product(t[1] - t[0], t[2] - t[0]); }

Corners grown(const Corners& t, double factor) {
  const Vector center = (t[0] + t[1] + t[2]) / 3;
  return {center + factor * (t[0] - center), center + factor * (t[1] - center),
          center + factor * (t[2] - center)};
}

/// Whether a point lies in the prism over a triangle, its sides included.
bool inPrism(const Vector& point, const Corners& t, const Vector& normal) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (CGAL::cross_product(normal, t[(i + 1) % 3] - t[i]) * (point - t[i]) < 0) return false;
  }
  return true;
}

/// The depth of `other` below a proper `face`, within the prism over it. The deepest point is a corner of
/// `other`, or a point where an edge of one meets a side of the other's prism.
double exactDepth(const Corners& face, const Corners& other) {
  const Vector normal = normalOf(face), other_normal = normalOf(other);
  Exact::FT deepest = 0;  // they meet
  const auto visit = [&](const Vector& point) {
    if (inPrism(point, face, normal)) deepest = std::max(deepest, Exact::FT(normal * (face[0] - point)));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    visit(other[i]);
    const Vector side = CGAL::cross_product(normal, face[(i + 1) % 3] - face[i]);
    for (std::size_t j = 0; j < 3; ++j) {
      const Vector edge = other[(j + 1) % 3] - other[j];
      const Exact::FT rise = side * edge;
      if (rise == 0) continue;
      const Exact::FT along = side * (face[i] - other[j]) / rise;
      if (along >= 0 && along <= 1) visit(other[j] + along * edge);
    }
    const Exact::FT slope = other_normal * normal;
    if (slope == 0) continue;
    const Vector above = face[i] + other_normal * (other[0] - face[i]) / slope * normal;
    if (inPrism(above, other, other_normal)) visit(above);
  }
  return CGAL::to_double(CGAL::exact(deepest)) /
         std::sqrt(CGAL::to_double(CGAL::exact(normal.squared_length())));
}

/// Twice the area divided by the square of the longest edge; small for thin faces.
double fatness(const Triangle& t) {
  const double longest = std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
  return std::sqrt(CGAL::to_double(CGAL::exact(normalOf(cornersOf(t)).squared_length()))) /
         (longest * longest);
}

TEST(TrianglePairCgal, depthOfContact_vs_exactKernel) {
  constexpr double kThin = 1e-12;  // contactOf gives no depth over thinner faces
  std::mt19937_64 random(103);
  int compared = 0, deep = 0;
  for (int i = 0; compared < 10'000 / kScale; ++i) {
    const auto [a, b, kind] = testing::hardPairOfUnitSize(random, static_cast<PairKind>(i % kPairKinds));
    if (!intersects(a, b)) continue;
    const double fat_a = fatness(a), fat_b = fatness(b);
    const auto undecided = [](double fat) { return fat > 0.9 * kThin && fat < 1.1 * kThin; };
    if (undecided(fat_a) || undecided(fat_b)) continue;
    ++compared;
    // A slightly smaller and a slightly larger face bracket the effect of rounding at the rim.
    double least = std::numeric_limits<double>::infinity(), most = least;
    const Corners in_a = cornersOf(a), in_b = cornersOf(b);
    for (const auto& [face, other, fat] : {std::tie(in_a, in_b, fat_a), std::tie(in_b, in_a, fat_b)}) {
      if (!(fat > kThin)) continue;
      const double rounding = 1e-14 / fat;
      least = std::min(least, exactDepth(grown(face, 1.0 - rounding), other) - rounding);
      most = std::min(most, exactDepth(grown(face, 1.0 + rounding), other) + rounding);
    }
    if (!(fat_a > kThin) && !(fat_b > kThin)) least = most = 0.0;
    const Contact contact = contactOf(a, b);
    deep += contact.distance < 0.0;
    ASSERT_GE(-contact.distance, least) << testing::nameOf(kind) << ", case " << i << '\n' << describe(a, b);
    ASSERT_LE(-contact.distance, most) << testing::nameOf(kind) << ", case " << i << '\n' << describe(a, b);
    ASSERT_NEAR(contact.normal.norm(), 1.0, 1e-14);
  }
  EXPECT_GT(deep, compared / 5);
}

}  // namespace
}  // namespace octoblisk
