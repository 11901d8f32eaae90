#include "geometry/triangle_convex.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/epa.h"
#include "geometry/triangle_pair.h"
#include "octoblisk/closest_point.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::randomPoint;
using testing::randomTriangle;
using testing::uniform;

constexpr double kFar = 100.0;

TEST(TriangleConvex, boxEqualsTheThirteenAxes) {
  std::mt19937_64 random(15);
  int hits = 0;
  constexpr int kCases = 20'000;
  for (int i = 0; i < kCases; ++i) {
    const Triangle triangle = randomTriangle(random, 2);
    const Obb box{randomPoint(random, 1), testing::randomRotation(random),
                  randomPoint(random, 1).cwiseAbs() + Vec3::Constant(0.05)};
    const double overlap = testing::boxTriangleOverlap(box, triangle);
    const auto contact = contactOf(triangle, ConvexBox(box), kFar);
    ASSERT_TRUE(contact);
    if (overlap > 1e-9) {
      ++hits;
      ASSERT_NEAR(contact->distance, -overlap, 1e-7) << "case " << i;
    } else if (overlap < -1e-9) {
      ASSERT_GT(contact->distance, 0.0) << "case " << i;
      ASSERT_GE(contact->distance, -overlap - 1e-9) << "case " << i;  // an axis proves at least its own gap
    }
    ASSERT_TRUE(
        (contact->point_on_b + contact->distance * contact->normal).isApprox(contact->point_on_a, 1e-6));
    ASSERT_TRUE(box.contains(contact->point_on_b, 1e-7));
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

/// A triangle as thin as rounding, a segment, a point, or a large triangle. Most pass through the unit cube.
Triangle awkwardTriangle(std::mt19937_64& random, int kind) {
  Triangle t = randomTriangle(random, kind == 2 ? 1.0 : 1.5);
  const double width = std::pow(10.0, uniform(random, -18, -5));
  switch (kind) {
    case 0:
      t[2] = t[0] + uniform(random, -0.3, 1.3) * (t[1] - t[0]);
      t[2] += randomPoint(random, width);
      break;
    case 1:
      t[2] = t[1];
      break;
    case 2:
      t[1] = t[0] + randomPoint(random, width);
      t[2] = t[0] + randomPoint(random, width);
      break;
    case 3:
      for (Vec3& corner : t) corner *= 1000.0;
      t[2] += 0.3 * randomPoint(random, 1) - centroidOf(t);
      break;
    default:  // along the box's axes, where faces of the difference are flat and edges parallel
      for (Vec3& corner : t) corner = (2.0 * corner).array().round() * 0.5;
  }
  return t;
}

TEST(TriangleConvex, sliversAndSegmentsInBoxesEqualTheThirteenAxes) {
  std::mt19937_64 random(19);
  int hits = 0;
  constexpr int kCases = 100'000;
  for (int i = 0; i < kCases; ++i) {
    const Triangle triangle = awkwardTriangle(random, i % 5);
    const double flatness = std::pow(10.0, uniform(random, i % 3 ? -1 : -4, 0.2));  // of the box
    const bool aligned = i % 5 == 4 && i % 2 == 0;
    const Obb box{aligned ? Vec3::Zero() : randomPoint(random, 0.3),
                  aligned ? Mat3::Identity() : testing::randomRotation(random),
                  Vec3(aligned ? 1.0 : uniform(random, 0.2, 1.4), 1.0, aligned ? 0.5 : flatness)};
    const double overlap = testing::boxTriangleOverlap(box, triangle);
    const double size = triangle[0].norm() + triangle[1].norm() + triangle[2].norm() + 3.0;
    const auto contact = contactOf(triangle, ConvexBox(box), 1e4);
    ASSERT_TRUE(contact);
    if (overlap > 1e-9 * size) {
      ++hits;
      ASSERT_NEAR(contact->distance, -overlap, 1e-9 * size) << "case " << i << ' ' << i % 5;
    } else if (overlap < -1e-9 * size) {
      ASSERT_GE(contact->distance, -overlap - 1e-9 * size) << "case " << i;
    }
    ASSERT_NEAR(contact->normal.norm(), 1.0, 1e-12);
    const Vec3 end = contact->point_on_b + contact->distance * contact->normal;
    ASSERT_LE((end - contact->point_on_a).norm(), 1e-8 * size) << "case " << i << ' ' << i % 5;
    ASSERT_TRUE(box.contains(contact->point_on_b, 1e-8 * size)) << "case " << i;
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

/// Hides everything except the body's support function, so only GJK and EPA apply.
class SupportAlone final : public Convex {
 public:
  explicit SupportAlone(const Convex& convex) : convex_(convex) {}
  Vec3 support(const Vec3& direction) const override { return convex_.support(direction); }
  double radius() const override { return convex_.radius(); }
  Vec3 middle() const override { return convex_.middle(); }

 private:
  const Convex& convex_;
};

struct Agreement {
  int cases = 0, cores_meet = 0, normals_differ = 0;
};

/// Compares the contact by axes or closed form with the contact by search. Distances are equal. Normals are
/// equal if the shortest way out is unique. The points are on the two bodies, at that distance.
void expectAsSearched(const Triangle& triangle, const Convex& convex, double size, Agreement& seen) {
  const auto found = contactOf(triangle, convex, 1e4),
             searched = contactOf(triangle, SupportAlone(convex), 1e4);
  ASSERT_TRUE(found && searched) << "case " << seen.cases;
  ASSERT_NEAR(found->distance, searched->distance, 1e-9 * size) << "case " << seen.cases;
  ASSERT_NEAR(found->normal.norm(), 1.0, 1e-12);
  const Vec3 end = found->point_on_b + found->distance * found->normal;
  ASSERT_LE((end - found->point_on_a).norm(), 1e-9 * size) << "case " << seen.cases;
  ASSERT_LE((closestPoint(triangle, found->point_on_a) - found->point_on_a).norm(), 1e-8 * size)
      << "case " << seen.cases;
  const Vec3 on_core = found->point_on_b - convex.radius() * found->normal;
  const auto at_point = contactOf({on_core, on_core, on_core}, SupportAlone(convex), 1e4);
  ASSERT_LE(at_point->distance, 1e-8 * size - convex.radius()) << "case " << seen.cases;
  // This contact alone separates the two, or proves them apart.
  const double low = std::min(
      {found->normal.dot(triangle[0]), found->normal.dot(triangle[1]), found->normal.dot(triangle[2])});
  const double high = found->normal.dot(convex.support(found->normal)) + convex.radius();
  ASSERT_NEAR(low - high, found->distance, 1e-8 * size) << "case " << seen.cases;
  ++seen.cases;
  seen.cores_meet += found->distance < -convex.radius();
  seen.normals_differ += found->normal.dot(searched->normal) < 1.0 - 1e-6;
}

TEST(TriangleConvex, hullsByTheirFacesEqualSearches) {
  std::mt19937_64 random(22);
  Agreement seen;
  for (int i = 0; i < 30'000; ++i) {
    std::vector<Vec3> points;
    for (int p = 0; p < 4 + i % 29; ++p) points.push_back(randomPoint(random, 1).normalized());
    const ConvexHull hull(points, i % 3 ? 0.0 : 0.1);
    ASSERT_FALSE(hull.faces().empty());
    const double size = std::pow(10.0, uniform(random, -2, 2));  // of the triangle: small and large
    Triangle triangle = randomTriangle(random, size);
    const Vec3 middle = centroidOf(triangle), to = randomPoint(random, 1.1);
    for (Vec3& corner : triangle) corner += to - middle;
    expectAsSearched(triangle, hull, 3.0 + 3.0 * size, seen);
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(seen.cores_meet, seen.cases * 3 / 10);
  EXPECT_LT(seen.cores_meet, seen.cases * 7 / 10);
  EXPECT_LT(seen.normals_differ, seen.cases / 1000);  // two equally short directions out
}

/// A narrow triangle that still has a normal, a large one, or one along the axes.
Triangle awkwardTriangleWithNormal(std::mt19937_64& random, int kind) {
  if (kind != 0) return awkwardTriangle(random, kind + 2);
  Triangle t = randomTriangle(random, 1.5);
  const double width = std::pow(10.0, uniform(random, -5, -1));
  t[2] = t[0] + uniform(random, -0.3, 1.3) * (t[1] - t[0]);
  t[2] += randomPoint(random, width);
  return t;
}

TEST(TriangleConvex, awkwardTrianglesInHullsEqualSearches) {
  std::mt19937_64 random(23);
  Agreement seen;
  for (int i = 0; i < 40'000; ++i) {
    const Triangle triangle = awkwardTriangleWithNormal(random, i % 3);
    const bool aligned = i % 3 == 2;  // a hull with its corners on the triangles' grid
    std::vector<Vec3> points;
    for (int p = 0; p < 4 + i % 20; ++p) {
      const Vec3 point = randomPoint(random, 1.2);
      points.push_back(aligned ? Vec3((2.0 * point).array().round() * 0.5) : point);
    }
    const ConvexHull hull(points);
    const double size = triangle[0].norm() + triangle[1].norm() + triangle[2].norm() + 3.0;
    expectAsSearched(triangle, hull, size, seen);
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(seen.cores_meet, seen.cases * 3 / 10);
  EXPECT_LT(seen.cores_meet, seen.cases * 7 / 10);
}

TEST(TriangleConvex, spheresAndCapsulesEqualSearches) {
  std::mt19937_64 random(24);
  Agreement seen;
  for (int i = 0; i < 30'000; ++i) {
    const Triangle triangle =
        i % 4 == 0 ? awkwardTriangleWithNormal(random, i / 4 % 3) : randomTriangle(random, 1.2);
    const double longest = std::max((triangle[1] - triangle[0]).norm(), (triangle[2] - triangle[0]).norm());
    if (scaledNormal(triangle).norm() < 1e-5 * longest * longest) continue;  // has no reliable normal
    Vec3 from = randomPoint(random, 1), to = randomPoint(random, 1);
    const Vec3 inside = triangle[0] + 0.4 * (triangle[1] - triangle[0]) + 0.3 * (triangle[2] - triangle[0]);
    if (i % 2 == 0) to = inside + uniform(random, 0, 1) * (inside - from);  // through it
    if (i % 7 == 0) {                                                       // along it, and in it
      from = inside;
      to = from + uniform(random, -1, 1) * (triangle[1] - triangle[0]);
    }
    const ConvexHull body(i % 3 ? std::vector<Vec3>{from, to} : std::vector<Vec3>{from},
                          uniform(random, 0, 0.5));
    const double size = triangle[0].norm() + triangle[1].norm() + triangle[2].norm() + 3.0;
    expectAsSearched(triangle, body, size, seen);
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(seen.cores_meet, seen.cases * 2 / 10);  // a capsule's axis is through the triangle
  EXPECT_LT(seen.cores_meet, seen.cases * 7 / 10);
}

using LongVec3 = Eigen::Matrix<long double, 3, 1>;

/// The distance of a point to a triangle, with 11 more bits.
double longDistance(const Triangle& triangle, const Vec3& point) {
  std::array<LongVec3, 3> corner;
  for (std::size_t v = 0; v < 3; ++v) corner[v] = triangle[v].cast<long double>();
  const LongVec3 from = point.cast<long double>();
  const LongVec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  bool is_over = normal.squaredNorm() > 0.0L;
  long double least = std::numeric_limits<long double>::infinity();
  for (std::size_t v = 0; v < 3; ++v) {
    const LongVec3 edge = corner[(v + 1) % 3] - corner[v], offset = from - corner[v];
    if (normal.dot(edge.cross(offset)) < 0.0L) is_over = false;
    const long double part = std::clamp(edge.dot(offset) / edge.squaredNorm(), 0.0L, 1.0L);
    if (edge.squaredNorm() > 0.0L) least = std::min(least, (part * edge - offset).norm());
  }
  if (is_over) least = std::min(least, std::abs(normal.normalized().dot(from - corner[0])));
  return static_cast<double>(least);
}

TEST(TriangleConvex, spheresOnSlivers_vs_long_double) {
  std::mt19937_64 random(108);
  int cases = 0, over = 0;
  for (int i = 0; i < 50'000; ++i) {
    const Triangle triangle = awkwardTriangle(random, i % 2);
    const double u = uniform(random, 0, 1), v = uniform(random, 0, 1 - u);
    const Vec3 on_it = triangle[0] + u * (triangle[1] - triangle[0]) + v * (triangle[2] - triangle[0]);
    const Vec3 center = on_it + randomPoint(random, std::pow(10.0, uniform(random, -12, 0)));
    const double expected = longDistance(triangle, center), radius = i % 3 ? 0.1 : 0.0;
    const auto contact = contactOf(triangle, ConvexHull({center}, radius), kFar);
    ASSERT_TRUE(contact);
    ASSERT_NEAR(contact->distance, expected - radius, 1e-7) << "case " << i;
    ASSERT_NEAR((closestPoint(triangle, center) - center).norm(), expected, 1e-7) << "case " << i;
    ASSERT_NEAR(contact->normal.norm(), 1.0, 1e-12) << "case " << i;
    ASSERT_LE(longDistance(triangle, contact->point_on_a), 1e-9) << "case " << i;
    ++cases;
    over += expected < 0.01;
  }
  EXPECT_GT(over, cases / 2);
  for (const double width : {1e-100, 1e-160, 1e-200, 1e-300}) {  // the square of the area underflows
    const Triangle triangle = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, width, 0)};
    const auto contact = contactOf(triangle, ConvexHull({Vec3(0.3, 0, 0)}, 0.1), kFar);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->normal.norm(), 1.0, 1e-12) << width;
    EXPECT_NEAR(contact->distance, -0.1, 1e-12) << width;
  }
}

TEST(TriangleConvex, spheresFarFromTheOriginKnowTheirSide) {
  std::mt19937_64 random(109);
  int cases = 0;
  for (int i = 0; i < 20'000; ++i) {
    Triangle triangle = randomTriangle(random, 1.0);
    if (scaledNormal(triangle).norm() < 0.1) continue;
    const Vec3 offset = randomPoint(random, 1e6);
    for (Vec3& corner : triangle) corner += offset;
    const Vec3 center = centroidOf(triangle) + uniform(random, -1e-9, 1e-9) * unitNormal(triangle);
    const LongVec3 first = triangle[0].cast<long double>();
    const LongVec3 normal =
        (triangle[1].cast<long double>() - first).cross(triangle[2].cast<long double>() - first).normalized();
    const auto height = static_cast<double>(normal.dot(center.cast<long double>() - first));
    if (std::abs(height) < 1e-13) continue;
    ++cases;
    const auto contact = contactOf(triangle, ConvexHull({center}), kFar);
    ASSERT_TRUE(contact);
    ASSERT_NEAR(contact->distance, std::abs(height), 1e-14) << "case " << i;
    ASSERT_GT(-height * contact->normal.dot(scaledNormal(triangle)), 0.0) << "case " << i;
    ASSERT_TRUE(contactOf(triangle, ConvexHull({center}), contact->distance)) << "case " << i;
  }
  EXPECT_GT(cases, 10'000);
}

TEST(TriangleConvex, flatOnEachOtherTheyTouchInTheMiddle) {
  // Half of the box extends beyond the floor's edge. The shared area is 1 x 2.
  const Triangle floor = {Vec3(0, -100, 0), Vec3(0, 100, 0), Vec3(-100, 0, 0)};
  for (const double height : {0.0, 0.01, -0.01}) {
    const ConvexBox box({Vec3(0, 0, 1 + height), Mat3::Identity(), Vec3::Ones()});
    const auto contact = contactOf(floor, box, 0.1);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->distance, height, 1e-12);
    EXPECT_NEAR(contact->normal.z(), -1.0, 1e-12);
    EXPECT_TRUE(contact->point_on_b.isApprox(Vec3(-0.5, 0, height), 1e-6)) << contact->point_on_b.transpose();
  }
}

TEST(TriangleConvex, depthFromAFlatSimplex) {
  // A flat simplex that GJK may end with after rounding: corners of one face, one edge or one corner of the
  // difference.
  const ConvexBox box({Vec3::Zero(), Mat3::Identity(), Vec3(1, 1, 0.5)});
  const Triangle triangle = {Vec3(-4, -4, 0.25), Vec3(4, -4, 0.25), Vec3(0, 4, 0.25)};
  const double thin = 1e-13;
  for (const auto& directions : {std::array{Vec3(1, 1, 1), Vec3(1, -1, 1), Vec3(-1, -1, 1), Vec3(-1, 1, 1)},
                                 std::array{Vec3(1, 1, 1), Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(1, 1, -1)},
                                 std::array{Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)}}) {
    Simplex simplex;
    for (const Vec3& direction : directions) {
      SupportPoint point = supportOfDifference(triangle, box, direction);
      point.difference.z() += thin * simplex.count;
      simplex.point[simplex.count++] = point;
    }
    const auto found = epa(triangle, box, simplex);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance, -0.25, 1e-9);
    EXPECT_NEAR(found->normal.z(), 1.0, 1e-9);
  }
}

TEST(TriangleConvex, sphereAndCapsuleEqualTheirClosedForms) {
  std::mt19937_64 random(16);
  int hits = 0;
  constexpr int kCases = 20'000;
  for (int i = 0; i < kCases; ++i) {
    const Triangle triangle = randomTriangle(random, 2);
    const Vec3 from = randomPoint(random, 2), to = i % 2 ? from : randomPoint(random, 2);
    const double radius = uniform(random, 0.1, 1.2);
    const Triangle axis = {from, to, to};
    if (intersects(triangle, axis)) continue;  // deep: EPA, checked below
    const double expected = closestPoints(triangle, axis).distance - radius;
    const auto contact = contactOf(triangle, ConvexHull({from, to}, radius), kFar);
    ASSERT_TRUE(contact);
    hits += expected < 0.0;
    ASSERT_NEAR(contact->distance, expected, 1e-9) << "case " << i;
    ASSERT_NEAR((contact->point_on_a - contact->point_on_b).dot(contact->normal), contact->distance, 1e-9);
  }
  EXPECT_GT(hits, kCases * 2 / 10);
}

TEST(TriangleConvex, depthPartsAndNoLessDoes) {
  std::mt19937_64 random(17);
  int meeting = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Triangle triangle = randomTriangle(random, 1);
    std::vector<Vec3> points;
    for (int p = 0; p < 2 + i % 12; ++p) points.push_back(randomPoint(random, 1));
    const ConvexHull hull(points, i % 3 ? 0.0 : 0.2);
    const auto contact = contactOf(triangle, hull, 0.0);
    if (!contact || contact->distance > -1e-6) continue;
    ++meeting;
    const auto moved = [&](double factor) {
      return Pose{Mat3::Identity(), -contact->distance * factor * contact->normal} * triangle;
    };
    const auto after = contactOf(moved(1.0 + 1e-4), hull, kFar),
               before = contactOf(moved(1.0 - 1e-4), hull, kFar);
    ASSERT_GT(after->distance, 0.0) << "case " << i;
    ASSERT_LT(before->distance, 0.0) << "case " << i;
    for (int d = 0; d < 20; ++d) {  // no other direction gives a shorter way out
      const Vec3 direction = randomPoint(random, 1).normalized();
      const Pose shift{Mat3::Identity(), -contact->distance * 0.99 * direction};
      ASSERT_LE(contactOf(shift * triangle, hull, kFar)->distance, 1e-9) << "case " << i;
    }
  }
  EXPECT_GT(meeting, 1'000);
}

TEST(TriangleConvex, centreOfASphereOnTheTriangle) {
  const Triangle triangle = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)};
  const auto contact = contactOf(triangle, ConvexHull({Vec3::Zero()}, 0.5), 0.0);
  ASSERT_TRUE(contact);
  EXPECT_DOUBLE_EQ(contact->distance, -0.5);
  EXPECT_NEAR(std::abs(contact->normal.z()), 1.0, 1e-12);
  EXPECT_NEAR(contact->point_on_a.norm(), 0.0, 1e-12);  // the centre, not a corner
}

TEST(TriangleConvex, nothingBeyondTheThreshold) {
  const Triangle triangle = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)};
  const ConvexHull sphere({Vec3(0, 0, 2)}, 0.5);
  EXPECT_FALSE(contactOf(triangle, sphere, 1.49));
  ASSERT_TRUE(contactOf(triangle, sphere, 1.51));
  EXPECT_NEAR(contactOf(triangle, sphere, 1.51)->distance, 1.5, 1e-12);
}

TEST(TriangleConvex, aLargeTriangleDoesNotWidenTheTolerance) {
  // A core in single precision over a floor a thousand times its size.
  class Rough final : public Convex {
   public:
    explicit Rough(const Obb& box) : box_(box) {}
    Vec3 support(const Vec3& direction) const override { return box_.support(direction); }
    double radius() const override { return 0.04; }
    double precision() const override { return 2e-6; }

   private:
    ConvexBox box_;
  };
  std::mt19937_64 random(18);
  for (int i = 0; i < 500; ++i) {
    const Mat3 tilt = Eigen::AngleAxisd(0.1, testing::randomPoint(random, 1).normalized()).toRotationMatrix();
    const Obb box{Vec3::Zero(), tilt, Vec3::Constant(0.46)};
    double lowest = 0.0;
    for (int k = 0; k < 3; ++k) lowest -= 0.46 * std::abs(tilt(2, k));
    const double floor = lowest - 0.035, x = uniform(random, -300, 300), y = uniform(random, -100, 300);
    const Triangle triangle = {Vec3(x - 1000, y - 1000, floor), Vec3(x + 1000, y - 1000, floor),
                               Vec3(x, y + 1000, floor)};
    const auto contact = contactOf(triangle, Rough(box), 0.02);
    ASSERT_TRUE(contact) << "case " << i;
    ASSERT_NEAR(contact->distance, -0.005, 1e-5) << "case " << i;
  }
}

/// A body may know more points or faces than the search of axes has room for.
TEST(TriangleConvex, manyFaces) {
  class Prism final : public Convex {
   public:
    Prism() {
      for (int side = 0; side < 400; ++side) {
        const Mat3 turn =
            Eigen::AngleAxisd(0.005 * std::numbers::pi * side, Vec3::UnitZ()).toRotationMatrix();
        for (const double z : {-1.0, 1.0}) points_.emplace_back(turn * Vec3(1, 0, z));
        faces_.push_back({turn.col(0), 1.0});
      }
    }
    Vec3 support(const Vec3& direction) const override { return farthest(points_, direction); }
    std::span<const Vec3> points() const override { return points_; }
    HullFaces faces() const override { return {faces_, {}}; }

   private:
    std::vector<Vec3> points_;
    std::vector<HullFace> faces_;
  };
  class RepeatedBox final : public Convex {
   public:
    RepeatedBox() {
      for (int repeat = 0; repeat < 50; ++repeat) {
        faces_.insert(faces_.end(), box_.faces().faces.begin(), box_.faces().faces.end());
        edges_.insert(edges_.end(), box_.faces().edges.begin(), box_.faces().edges.end());
      }
    }
    Vec3 support(const Vec3& direction) const override { return box_.support(direction); }
    std::span<const Vec3> points() const override { return box_.points(); }
    HullFaces faces() const override { return {faces_, edges_}; }

   private:
    ConvexBox box_{Obb{Vec3::Zero(), Mat3::Identity(), Vec3::Ones()}};
    std::vector<HullFace> faces_;
    std::vector<HullEdge> edges_;
  };
  const Triangle triangle = {Vec3(3, 0, 0), Vec3(4, 1, 0), Vec3(4, 0, 1)};
  const auto of_prism = contactOf(triangle, Prism(), 5.0), of_box = contactOf(triangle, RepeatedBox(), 5.0);
  ASSERT_TRUE(of_prism && of_box);
  EXPECT_NEAR(of_prism->distance, 2.0, 1e-9);
  EXPECT_NEAR(of_box->distance, 2.0, 1e-9);
}

TEST(TriangleConvex, refusesBadHulls) {
  EXPECT_THROW(ConvexHull({}), std::invalid_argument);
  EXPECT_THROW(ConvexHull({Vec3::Zero()}, -1.0), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk
