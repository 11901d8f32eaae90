// Compares rays with a brute-force search over every triangle, and the test of one triangle with integer
// arithmetic.
#include "octoblisk/raycast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "geometry/ray_triangle.h"
#include "query/ray_walk.h"
#include "shared/meshes.h"
#include "shared/solids.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::SharedMesh;
using testing::uniform;

using IntVec3 = Eigen::Matrix<std::int64_t, 3, 1>;

std::int64_t tripleProduct(const IntVec3& a, const IntVec3& b, const IntVec3& c) {
  return a.x() * (b.y() * c.z() - b.z() * c.y()) + a.y() * (b.z() * c.x() - b.x() * c.z()) +
         a.z() * (b.x() * c.y() - b.y() * c.x());
}

struct Fraction {
  std::int64_t numerator, denominator;
};

/// t of the crossing by Cramer's rule for origin + t · d = a + u · (b−a) + v · (c−a): t, u, v >= 0, u + v
/// <= 1.
std::optional<Fraction> integerCrossing(const IntVec3& origin, const IntVec3& d,
                                        const std::array<IntVec3, 3>& triangle) {
  const IntVec3 ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0], ao = origin - triangle[0];
  const IntVec3 back = -d;
  std::int64_t determinant = tripleProduct(back, ab, ac);
  if (determinant == 0) return std::nullopt;
  std::int64_t t = tripleProduct(ao, ab, ac), u = tripleProduct(back, ao, ac),
               v = tripleProduct(back, ab, ao);
  if (determinant < 0) {
    for (std::int64_t* value : {&determinant, &t, &u, &v}) *value = -*value;
  }
  if (t < 0 || u < 0 || v < 0 || u + v > determinant) return std::nullopt;
  return Fraction{t, determinant};
}

TEST(RayTriangle, crossing_vs_integers) {
  std::mt19937_64 random(71);
  int hits = 0, grazing = 0, cases = 0;
  for (const int range : {1, 2, 4, 100, 1 << 18}) {
    const auto point = [&]() -> IntVec3 {
      const auto coordinate = [&] {
        return static_cast<std::int64_t>(std::floor(uniform(random, -range, range + 1)));
      };
      const auto x = coordinate(), y = coordinate();
      return {x, y, coordinate()};
    };
    for (int i = 0; i < 20000; ++i) {
      const std::array<IntVec3, 3> triangle = {point(), point(), point()};
      const IntVec3 origin = point();
      // Towards a random point, a corner, the middle of a side or of the triangle.
      IntVec3 direction = point() - origin;
      switch (i % 6) {
        case 0:
          direction = triangle[0] - origin;
          break;
        case 1:
          direction = triangle[0] + triangle[1] - 2 * origin;
          break;
        case 2:
          direction = triangle[0] + triangle[1] + triangle[2] - 3 * origin;
          break;
        default:
          break;
      }
      const auto expected = integerCrossing(origin, direction, triangle);
      Triangle corners;
      for (std::size_t v = 0; v < 3; ++v) corners[v] = triangle[v].cast<double>();
      const auto found = crossing(origin.cast<double>(), direction.cast<double>(), corners);
      ASSERT_EQ(found.has_value(), expected.has_value()) << range << ' ' << i;
      ++cases;
      hits += expected.has_value();
      if (!found) continue;
      const double t = static_cast<double>(expected->numerator) / static_cast<double>(expected->denominator);
      ASSERT_NEAR(found->t, t, 1e-9 * t) << range << ' ' << i;
      grazing += i % 6 < 2;
      const auto rate = direction.dot((triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]));
      ASSERT_EQ(found->back_face, rate > 0);
    }
  }
  EXPECT_GT(hits, cases * 3 / 10);
  EXPECT_LT(hits, cases * 7 / 10);
  EXPECT_GT(grazing, 10000);
}

TEST(RayTriangle, tIsPreciseWhereTheRayIsAllButInThePlane) {
  // A triangle around the origin in the plane z = slope · x, and a ray along x at the height `lift`.
  const double lift = 0x1p-40;
  for (const double slope : {0x1p-10, 0x1p-30, 0x1p-39}) {
    const Triangle triangle = {Vec3(-4, -4, -4 * slope), Vec3(4, -4, 4 * slope), Vec3(0, 8, 0)};
    const auto found = crossing(Vec3(-1000, 0.5, lift), Vec3(1, 0, 0), triangle);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->t, 1000 + lift / slope, 1e-6);
  }
}

std::vector<RayHit> bruteForceHits(const TriangleMesh& mesh, const Ray& ray) {
  std::vector<RayHit> hits;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto found = crossing(ray.origin, ray.direction, mesh.triangle(t));
    if (!found || found->t > ray.t_max || (ray.cull_back_faces && found->back_face)) continue;
    hits.push_back({found->t, t, ray.origin + found->t * ray.direction,
                    scaledNormal(mesh.triangle(t)).stableNormalized(), found->back_face});
  }
  std::ranges::sort(hits, {}, [](const RayHit& hit) { return std::tie(hit.t, hit.triangle); });
  return hits;
}

void expectEqual(const RayHit& found, const RayHit& expected) {
  EXPECT_EQ(found.t, expected.t);
  EXPECT_EQ(found.triangle, expected.triangle);
  EXPECT_EQ(found.point, expected.point);
  EXPECT_EQ(found.normal, expected.normal);
  EXPECT_EQ(found.back_face, expected.back_face);
}

/// Makes rays of all kinds around a mesh, in turn.
class RayMaker {
 public:
  explicit RayMaker(const TriangleMesh& mesh) : mesh_(mesh) {}
  static constexpr int kKinds = 8;

  Ray make(int kind) {
    const Vec3 half = mesh_.bounds().halfExtents(), center = mesh_.bounds().center();
    const auto around = [&](double size) -> Vec3 {
      return center +
             size * half.cwiseMax(0.2 * half.maxCoeff()).cwiseProduct(testing::randomPoint(random_, 1.0));
    };
    const Triangle triangle = mesh_.triangle(random_() % mesh_.triangleCount());
    Ray ray{.origin = around(1.6), .t_max = 1.0};
    Vec3 target = around(1.6);
    switch (kind) {
      case 0:
        break;  // anywhere
      case 1:
        target = triangle[0];
        break;  // at a corner, with t = 1 at the limit
      case 2:
        target = 0.5 * (triangle[0] + triangle[1]);
        break;  // at an edge
      case 3:
        ray.origin = 2.0 * triangle[0] - triangle[1], target = triangle[1];
        break;   // along an edge
      case 4: {  // along an axis, through a corner every other time
        const auto axis = static_cast<Eigen::Index>(random_() % 3);
        if (random_() % 2 == 0) ray.origin = triangle[0];
        ray.origin[axis] = center[axis] - 2.0 * half.maxCoeff();
        target = ray.origin;
        target[axis] += 3.0 * half.maxCoeff();
        break;
      }
      case 5:
        ray.origin = triangle[0];
        break;  // from a corner
      case 6:
        ray.origin = centroidOf(triangle);
        break;  // from the surface
      default:
        ray.origin = center + 100.0 * (ray.origin - center);
        break;  // from afar
    }
    ray.direction = target - ray.origin;
    if (random_() % 4 == 0) {  // of a different length, and unbounded
      ray.direction *= uniform(random_, 0.01, 100.0);
      ray.t_max = std::numeric_limits<double>::infinity();
    }
    if (random_() % 3 == 0) ray.t_max *= uniform(random_, 0.0, 1.0);
    ray.cull_back_faces = random_() % 4 == 0;
    return ray;
  }

 private:
  const TriangleMesh& mesh_;
  std::mt19937_64 random_{72};
};

class Rays : public ::testing::TestWithParam<PartitionKind> {};

TEST_P(Rays, hits_vs_bruteforce) {
  std::mt19937_64 random(73);
  struct RayScene {
    const char* name;
    SharedMesh mesh;
  };
  const SharedMesh torus = testing::torus(3, 1, 32, 16);
  const RayScene cases[] = {{"torus", torus},
                            {"fan", testing::fan(9, 10)},
                            {"soup", testing::soup(random, 600, 5, 0.8)},
                            {"sheet", testing::waveSheet(4, 0.5, 16)},
                            {"flat sheet", testing::waveSheet(4, 0.0, 16)},
                            {"box", testing::boxMesh({1, 2, 3})},
                            {"tiny torus", testing::scaledAndMoved(torus, 1e-6, Vec3::Zero())},
                            {"huge torus", testing::scaledAndMoved(torus, 1e6, Vec3::Zero())},
                            {"torus afar", testing::scaledAndMoved(torus, 1.0, Vec3(1e6, -2e6, 3e6))},
                            {"tiny torus afar", testing::scaledAndMoved(torus, 1e-6, Vec3(1, -2, 3))}};
  std::vector<RayHit> found;
  int rays = 0, hits = 0;
  for (const RayScene& scene : cases) {
    const ClusteredOctree tree = ClusteredOctree::build(scene.mesh, {.partition = GetParam()});
    RayMaker maker(*scene.mesh);
    for (int i = 0; i < 150 * RayMaker::kKinds; ++i) {
      const Ray ray = maker.make(i % RayMaker::kKinds);
      const std::vector<RayHit> expected = bruteForceHits(*scene.mesh, ray);
      SCOPED_TRACE(::testing::Message() << scene.name << ", ray " << i);
      allHits(tree, ray, found);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t h = 0; h < found.size(); ++h) expectEqual(found[h], expected[h]);
      const std::optional<RayHit> closest = closestHit(tree, ray);
      ASSERT_EQ(closest.has_value(), !expected.empty());
      if (closest) expectEqual(*closest, expected.front());
      ASSERT_EQ(anyHit(tree, ray), !expected.empty());
      ASSERT_FALSE(HasFailure());
      ++rays;
      hits += !expected.empty();
    }
  }
  EXPECT_GT(hits, rays * 3 / 10);
  EXPECT_LT(hits, rays * 7 / 10);
}

INSTANTIATE_TEST_SUITE_P(Partitions, Rays, ::testing::Values(PartitionKind::clustering, PartitionKind::paper),
                         [](const auto& kind) {
                           return kind.param == PartitionKind::paper ? "paper" : "clustering";
                         });

TEST(Raycast, noRaySlipsThroughEdgesOrCorners) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const SharedMesh mesh = testing::scaledAndMoved(testing::torus(3, 1, 40, 24), scale, Vec3::Zero());
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    std::mt19937_64 random(74);
    for (int i = 0; i < 3000; ++i) {
      // From outside through a corner or edge of the surface to a point of the circle inside the tube.
      const Triangle triangle = mesh->triangle(random() % mesh->triangleCount());
      const double share = i % 2 ? 0.0 : uniform(random, 0.0, 1.0);
      const Vec3 target = triangle[0] + share * (triangle[1] - triangle[0]);
      const Vec3 inside = 3.0 * scale * Vec3(target.x(), target.y(), 0.0).normalized();
      const Vec3 from = target + 0.5 * (target - inside) + testing::randomPoint(random, 0.2 * scale);
      const auto hit = closestHit(tree, {.origin = from, .direction = target - from});
      ASSERT_TRUE(hit) << i;
      ASSERT_FALSE(hit->back_face) << i;
      ASSERT_NEAR(hit->t, 1.0, 0.1) << i;
    }
  }
}

TEST(Raycast, raysIntoAClosedMeshComeOutAgain) {
  const SharedMesh mesh = testing::torus(3, 1, 40, 24);
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  std::mt19937_64 random(75);
  std::vector<RayHit> hits;
  int inside_count = 0, met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 origin = testing::randomPoint(random, 4.0).cwiseProduct(Vec3(1, 1, 0.2));
    const double from_circle = std::hypot(std::hypot(origin.x(), origin.y()) - 3.0, origin.z());
    if (from_circle > 0.97 && from_circle < 1.0) continue;  // between the facets and the true torus
    const bool inside = from_circle < 1.0;
    allHits(tree, {.origin = origin, .direction = testing::randomRotation(random).col(0)}, hits);
    ASSERT_EQ(hits.size() % 2, inside ? 1u : 0u) << i;
    for (std::size_t h = 0; h < hits.size(); ++h) ASSERT_EQ(hits[h].back_face, (h % 2 == 0) == inside) << i;
    inside_count += inside;
    met += !hits.empty();
  }
  EXPECT_GT(inside_count, 600);
  EXPECT_LT(inside_count, 1400);
  EXPECT_GT(met, inside_count + 100);
}

TEST(Raycast, theLimitOfTAndTheSurfaceItselfCount) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const Ray down{.origin = Vec3(0.25, 0.5, 3), .direction = Vec3(0, 0, -1)};
  const auto withLimit = [&](double t_max) {
    Ray ray = down;
    ray.t_max = t_max;
    return ray;
  };
  const auto hit = closestHit(box, withLimit(2.0));
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 2.0);
  EXPECT_EQ(hit->point, Vec3(0.25, 0.5, 1));
  EXPECT_EQ(hit->normal, Vec3(0, 0, 1));
  EXPECT_FALSE(hit->back_face);
  EXPECT_FALSE(closestHit(box, withLimit(std::nextafter(2.0, 0.0))));
  EXPECT_FALSE(closestHit(box, withLimit(-1.0)));

  const auto at_start = closestHit(box, {.origin = hit->point, .direction = Vec3(0.1, 0.2, 1)});
  ASSERT_TRUE(at_start);
  EXPECT_EQ(at_start->t, 0.0);
  EXPECT_TRUE(at_start->back_face);
}

TEST(Raycast, ofSeveralHitsAtOnceTheLowestTriangleWins) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const Ray at_diagonal{.origin = Vec3(0, 0, 3), .direction = Vec3(0, 0, -1)};
  std::vector<RayHit> hits;
  allHits(box, at_diagonal, hits);
  ASSERT_EQ(hits.size(), 4u);
  EXPECT_EQ(hits[0].t, hits[1].t);
  EXPECT_LT(hits[0].triangle, hits[1].triangle);
  EXPECT_EQ(closestHit(box, at_diagonal)->triangle, hits[0].triangle);
}

TEST(Raycast, backFacesAreCulledOnDemand) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const Ray out{.origin = Vec3(0.1, 0.2, 0.3), .direction = Vec3(1, 0.1, 0.2)};
  Ray culled = out;
  culled.cull_back_faces = true;
  EXPECT_TRUE(closestHit(box, out)->back_face);
  EXPECT_FALSE(closestHit(box, culled));
  EXPECT_FALSE(anyHit(box, culled));
}

TEST(Raycast, aVisitorEndsTheSearchWhereItLikes) {
  const SharedMesh mesh = testing::torus(3, 1, 32, 16);
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  const Ray ray{.origin = Vec3(-6, 0.1, 0.2), .direction = Vec3(1, 0.01, 0.02)};
  std::vector<RayHit> all;
  allHits(tree, ray, all);
  ASSERT_EQ(all.size(), 4u);

  std::vector<std::uint32_t> seen;
  const auto visitUntil = [&](double wanted) {
    seen.clear();
    detail::forEachCandidate(detail::treeOf(tree), ray, 0.0, [&](std::uint32_t triangle) {
      seen.push_back(triangle);
      return wanted;
    });
  };
  visitUntil(all[1].t);  // the two behind are beyond the limit
  for (int hit : {0, 1}) EXPECT_TRUE(std::ranges::count(seen, all[std::size_t(hit)].triangle)) << hit;
  EXPECT_LE(seen.size(), 3u);  // besides them, at most the rest of a leaf

  visitUntil(-1.0);
  EXPECT_EQ(seen.size(), 1u);
}

TEST(Raycast, raysThatAreNoneMeetNothing) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(anyHit(box, {.origin = Vec3::Zero(), .direction = Vec3::UnitX()}));
  EXPECT_FALSE(anyHit(box, {.origin = Vec3::Zero(), .direction = Vec3::Zero()}));
  EXPECT_FALSE(anyHit(box, {.origin = Vec3::Zero(), .direction = Vec3(1, nan, 0)}));
  EXPECT_FALSE(anyHit(box, {.origin = Vec3::Zero(), .direction = Vec3(inf, 0, 0)}));
  EXPECT_FALSE(anyHit(box, {.origin = Vec3(nan, 0, 0), .direction = Vec3::UnitX()}));
  EXPECT_FALSE(anyHit(box, {.origin = Vec3(0, -inf, 0), .direction = Vec3::UnitY()}));
  EXPECT_FALSE(anyHit(box, {.origin = Vec3::Zero(), .direction = Vec3::UnitX(), .t_max = nan}));
}

TEST(Raycast, theNormalOfASliverIsAUnitVectorOnTheRightSide) {
  constexpr double kUlp = 0x1p-52;
  const ClusteredOctree sliver = ClusteredOctree::build(std::make_shared<const TriangleMesh>(
      std::vector<Vec3>{{0, 0, 0}, {1, 1 + kUlp, 0}, {1 + kUlp, 1 + 2 * kUlp, 0}},
      std::vector<TriangleMesh::Indices>{{0, 1, 2}}));
  for (const double side : {1.0, -1.0}) {
    const auto hit =
        closestHit(sliver, {.origin = Vec3(1, 1 + kUlp, 5 * side), .direction = Vec3(0, 0, -side)});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, 5.0);
    EXPECT_EQ(hit->normal.norm(), 1.0);
    EXPECT_EQ(hit->back_face, hit->normal.z() * -side > 0.0);
  }
}

}  // namespace
}  // namespace octoblisk
