// Fills seeded polygons, and checks that the triangles cover them once.
#include "geometry/polygon_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/predicates.h"
#include "shared/meshes.h"

namespace octoblisk::detail {
namespace {

using testing::uniform;

struct Polygon2 {
  std::vector<Vec2> points;
  std::vector<Ring> rings;  // the outer one, then holes

  void add(const std::vector<Vec2>& ring) {
    rings.emplace_back();
    for (const Vec2& point : ring) {
      rings.back().push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(point);
    }
  }
};

double area(const std::vector<Vec2>& points, const Ring& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = points[ring[i]], &b = points[ring[(i + 1) % ring.size()]];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// As all triangles turn left and have the polygon's area, they do not overlap. Where corners lie on an edge,
/// they are corners of the triangles there.
void expectFilled(const Polygon2& polygon) {
  const auto triangles = polygonTriangles(polygon.points, polygon.rings.front(),
                                          {polygon.rings.begin() + 1, polygon.rings.end()});
  const std::size_t holes = polygon.rings.size() - 1;
  ASSERT_EQ(triangles.size(), polygon.points.size() + 2 * holes - 2);
  double expected = 0.0, found = 0.0;
  for (const Ring& ring : polygon.rings) expected += area(polygon.points, ring);
  std::vector<bool> is_used(polygon.points.size(), false);
  for (const auto& [a, b, c] : triangles) {
    ASSERT_GT(orient2d(polygon.points[a], polygon.points[b], polygon.points[c]), 0);
    found += area(polygon.points, {a, b, c});
    for (const std::uint32_t corner : {a, b, c}) is_used[corner] = true;
  }
  EXPECT_NEAR(found, expected, 1e-12 * std::abs(expected));
  EXPECT_TRUE(std::ranges::all_of(is_used, [](bool used) { return used; }));
  for (std::uint32_t i = 0; i < polygon.points.size(); ++i) {
    for (const auto& triangle : triangles) {
      if (std::ranges::find(triangle, i) != triangle.end()) continue;
      bool is_outside = false;
      for (std::size_t k = 0; k < 3; ++k) {
        is_outside |= orient2d(polygon.points[triangle[k]], polygon.points[triangle[(k + 1) % 3]],
                               polygon.points[i]) < 0;
      }
      ASSERT_TRUE(is_outside) << i;
    }
  }
}

/// A ring whose radius varies at random; turns right if `radius` is negative. The middle of some edges is a
/// corner too: those lie exactly on the edges, as coordinates are multiples of 2⁻²⁰.
std::vector<Vec2> star(std::mt19937_64& random, int corners, double radius, const Vec2& center) {
  std::vector<Vec2> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners, r = radius * uniform(random, 0.3, 1.0);
    Vec2 point = center + r * Vec2(std::cos(angle), radius > 0.0 ? std::sin(angle) : -std::sin(angle));
    for (double& coordinate : point) coordinate = std::ldexp(std::round(std::ldexp(coordinate, 20)), -20);
    if (i > 0 && i % 3 == 0) ring.push_back(0.5 * (ring.back() + point));
    ring.push_back(point);
  }
  return ring;
}

TEST(PolygonTriangles, coverSeededPolygonsOnce) {
  std::mt19937_64 random(641);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Polygon2 polygon;
    polygon.add(star(random, 3 + i, 1.0, {uniform(random, -5, 5), uniform(random, -5, 5)}));
    expectFilled(polygon);
  }
}

TEST(PolygonTriangles, leaveHolesOpen) {
  std::mt19937_64 random(642);
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    Polygon2 polygon;
    std::vector<Vec2> square;
    for (int k = 0; k < 32; ++k) {
      const double at = k % 8 / 4.0 - 1.0;
      square.push_back(k < 8 ? Vec2(at, -1) : k < 16 ? Vec2(1, at) : k < 24 ? Vec2(-at, 1) : Vec2(-1, -at));
    }
    polygon.add(square);
    for (int hole = 0; hole <= i % 9; ++hole) {
      polygon.add(
          star(random, 3 + (hole + i) % 7, -0.3, {hole % 3 * 0.625 - 0.625, hole / 3 * 0.625 - 0.625}));
    }
    expectFilled(polygon);
  }
}

TEST(PolygonTriangles, coverCombsAndSpirals) {
  Polygon2 comb;
  std::vector<Vec2> teeth = {{0, -1}, {40, -1}};
  for (int i = 40; i >= 0; --i) teeth.emplace_back(i, i % 2 == 0 ? 0.0 : 9.0);
  comb.add(teeth);
  expectFilled(comb);
  Polygon2 spiral;
  std::vector<Vec2> outside, inside;
  for (int i = 0; i < 80; ++i) {
    const double angle = 0.15 * i, r = 1.0 + 0.1 * i;
    outside.emplace_back(r * std::cos(angle), r * std::sin(angle));
    inside.emplace_back((r - 0.4) * std::cos(angle), (r - 0.4) * std::sin(angle));
  }
  outside.insert(outside.end(), inside.rbegin(), inside.rend());
  spiral.add(outside);
  expectFilled(spiral);
}

TEST(PolygonTriangles, refuseWhatTheyCannotFill) {
  const std::vector<Vec2> points = {{0, 0}, {1, 1}, {1, 0}, {0, 1}, {2, 0}, {3, 0}};
  EXPECT_TRUE(polygonTriangles(points, {0, 1, 2, 3}).empty()) << "an eight";
  EXPECT_TRUE(polygonTriangles(points, {0, 2, 4, 5}).empty()) << "no area";
  EXPECT_TRUE(polygonTriangles(points, {0, 1, 2}).empty()) << "turns right";
}

TEST(PolygonTriangles, enclosesAgreesWithAngles) {
  std::mt19937_64 random(643);
  int inside = 0;
  const std::vector<Vec2> ring = star(random, 40, 1.0, {0, 0});
  for (int i = 0; i < 2000; ++i) {
    const Vec2 point(uniform(random, -1, 1), uniform(random, -1, 1));
    double turn = 0.0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = ring[k] - point, b = ring[(k + 1) % ring.size()] - point;
      turn += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
    const bool expected = std::abs(turn) > std::numbers::pi;
    ASSERT_EQ(encloses(ring, point), expected);
    inside += expected;
  }
  EXPECT_GT(inside, 500);
  EXPECT_LT(inside, 1500);
}

}  // namespace
}  // namespace octoblisk::detail
