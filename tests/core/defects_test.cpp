// Tests what is inside a mesh with defects, how deep, and how heavy it is, against brute force and closed
// forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/solid.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk/depth.h"
#include "octoblisk/mass_properties.h"
#include "octoblisk/signed_distance.h"
#include "query/solid_parts.h"
#include "shared/defective_meshes.h"
#include "shared/posed_vertices.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::DefectiveMesh;
using testing::SharedMesh;

double sizeOf(const DefectiveMesh& defective) { return defective.mesh->bounds().halfExtents().norm(); }

/// A point of a triangle.
Vec3 pointOn(std::mt19937_64& random, const Triangle& triangle) {
  double u = testing::uniform(random, 0.0, 1.0), v = testing::uniform(random, 0.0, 1.0);
  if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
  return triangle[0] + u * (triangle[1] - triangle[0]) + v * (triangle[2] - triangle[0]);
}

/// A point in or around the mesh: near a triangle, or on the line through points of two triangles, up to the
/// stated part of their distance beyond them.
Vec3 samplePoint(std::mt19937_64& random, const TriangleMesh& mesh, double beyond = 0.3) {
  const auto anyTriangle = [&] { return mesh.triangle(random() % mesh.triangleCount()); };
  const Triangle triangle = anyTriangle();
  const Vec3 point = pointOn(random, triangle);
  const double size = mesh.bounds().halfExtents().norm();
  if (random() % 2 == 0) {
    const Vec3 way = pointOn(random, anyTriangle()) - point;
    return point + testing::uniform(random, -beyond, 1.0 + beyond) * way +
           testing::randomPoint(random, 0.02 * size);
  }
  const double height = size * std::pow(10.0, testing::uniform(random, -6.0, -1.0));
  const Vec3 normal = scaledNormal(triangle);
  if (normal.norm() < 1e-12 * size * size) return point + testing::randomPoint(random, height);
  return point + (random() % 2 ? height : -height) * normal.normalized();
}

struct PointCount {
  int inside = 0, outside = 0;
  int skipped = 0;   // on the surface, or with a winding number of half an integer
  int not_true = 0;  // inside by the winding number but not in the solid, or the reverse
};

/// Expects locate to give the rounded winding number, everywhere.
PointCount checkLocations(const DefectiveMesh& defective, const Surface& surface, int points) {
  std::mt19937_64 random(200);
  PointCount count;
  const double size = sizeOf(defective);
  constexpr double kAccuracy = 1e-5;  // at 1e-6 of the size from an open edge
  const SharedMesh single = testing::withoutCopies(*defective.mesh);
  for (int i = 0; i < points; ++i) {
    const Vec3 point = samplePoint(random, *defective.mesh);
    const double winding = testing::preciseWindingNumber(*single, point);
    if (std::abs(std::abs(winding - std::round(winding)) - 0.5) < 1e-6) {
      ++count.skipped;
      continue;
    }
    const bool is_inside = std::round(winding) != 0.0;
    const PointLocation expected = is_inside ? PointLocation::inside : PointLocation::outside;
    const PointLocation found = locate(surface, point);
    const PointLocation by_nearest = locate(surface, point, closestPoint(surface.tree(), point).value());
    const bool is_near =
        found == PointLocation::on_surface || std::abs(windingNumber(surface, point) - winding) < kAccuracy;
    if (found != expected || by_nearest != expected || !is_near) {
      if (testing::bruteForceDistance(*defective.mesh, point) < 1e-9 * size) {
        ++count.skipped;
        continue;
      }
      EXPECT_EQ(found, expected) << "point " << i << ' ' << winding;
      EXPECT_EQ(by_nearest, expected) << "point " << i << ' ' << winding;
      EXPECT_NEAR(windingNumber(surface, point), winding, kAccuracy);
    }
    ++(is_inside ? count.inside : count.outside);
    if (defective.clean && is_inside != defective.contains(point))
      count.not_true += defective.distanceToBoundary(point) > 3.0 * defective.gap + 1e-9 * size;
  }
  return count;
}

void checkMass(const DefectiveMesh& defective, const Surface& surface) {
  const MassProperties found = massProperties(surface);
  EXPECT_EQ(found.is_solid, defective.is_closed);
  const MassProperties of_mesh = massProperties(*defective.mesh);
  EXPECT_EQ(of_mesh.is_solid, defective.is_closed);
  if (!defective.is_closed) return;
  const testing::Moments expected = defective.moments();
  const double size = defective.size(), tolerance = 1e-10 + 10.0 * defective.gap / size;
  if (defective.volume > 0.0) {
    EXPECT_NEAR(expected.volume, defective.volume, 1e-10 * defective.volume);
  }
  for (const MassProperties& mass : {found, of_mesh}) {
    EXPECT_NEAR(mass.volume, expected.volume, tolerance * expected.volume);
    EXPECT_LT((mass.center_of_mass - expected.center).norm(), tolerance * size);
    EXPECT_LT((mass.inertia - expected.inertia).norm(), tolerance * expected.inertia.norm());
  }
}

/// The points of a grid on the faces of a box.
std::vector<Vec3> pointsOn(double half) {
  constexpr int kSteps = 4;
  std::vector<Vec3> points;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        for (const double side : {-half, half}) {
          Vec3 point;
          point[axis] = side;
          point[(axis + 1) % 3] = half * (2.0 * i / kSteps - 1.0);
          point[(axis + 2) % 3] = half * (2.0 * j / kSteps - 1.0);
          points.push_back(point);
        }
      }
    }
  }
  return points;
}

struct ProbeCount {
  int inside = 0, outside = 0, touching = 0;
};

/// Expects the depth, signed distance and containment of small cubes to be those of the solid.
ProbeCount checkProbes(const DefectiveMesh& defective, const Surface& surface, int probes) {
  std::mt19937_64 random(201);
  ProbeCount count;
  const double size = defective.size(), tolerance = 1e-6 * size + 3.0 * defective.gap;
  const double half = 0.03 * size, speck_half = 1e-8 * size;
  const Solid cube(testing::boxMesh(Vec3::Constant(half))),
      speck(testing::boxMesh(Vec3::Constant(speck_half)));
  DepthQuery query;
  for (int i = 0; i < probes; ++i) {
    const Pose pose{testing::randomRotation(random), samplePoint(random, *defective.clean, 0.8)};
    const bool is_inside = defective.contains(pose.translation);
    const double away = defective.distanceToBoundary(pose.translation);
    if (away < 1e-5 * size + 3.0 * defective.gap) continue;
    SCOPED_TRACE(::testing::Message() << "probe " << i << " at " << pose.translation.transpose());
    {  // a cube that is hardly more than a point
      const GougeDepth found = query.deepest(surface, speck.surface, pose, 1e-9 * size);
      EXPECT_EQ(found.gouging, is_inside ? Gouging::found : Gouging::none);
      EXPECT_TRUE(found.is_known);
      EXPECT_NEAR(found.depth, is_inside ? away : 0.0, tolerance);
      const double expected =
          is_inside ? -away : testing::bruteForceDistance(*defective.mesh, pose.translation);
      const SignedDistance ab = signedDistance(surface, speck.surface, pose),
                           ba = signedDistance(speck.surface, surface, pose.inverse());
      EXPECT_NEAR(ab.distance, expected, tolerance);
      EXPECT_NEAR(ba.distance, expected, tolerance);
      EXPECT_NEAR((ab.point_on_a - ab.point_on_b).norm(), std::abs(ab.distance), 1e-9 * size);
      EXPECT_LT((ab.point_on_b - pose.translation).norm(), 2.0 * speck_half);
      EXPECT_LT(testing::bruteForceDistance(defective.mesh->triangle(ab.triangle_a), ab.point_on_a),
                1e-9 * size);
    }
    const Containment of_ab = containment(surface, cube.surface, pose),
                      of_ba = containment(cube.surface, surface, pose.inverse());
    if (away < 0.9 * half) {
      ++count.touching;
      EXPECT_EQ(of_ab, Containment::touching);
      EXPECT_EQ(of_ba, Containment::touching);
    }
    if (away < std::sqrt(3.0) * half + 3.0 * defective.gap) continue;
    ++(is_inside ? count.inside : count.outside);
    EXPECT_EQ(of_ab, is_inside ? Containment::b_inside_a : Containment::apart);
    EXPECT_EQ(of_ba, is_inside ? Containment::a_inside_b : Containment::apart);
    const GougeDepth found = query.deepest(surface, cube.surface, pose, 1e-7 * size);
    EXPECT_EQ(found.gouging, is_inside ? Gouging::found : Gouging::none);
    const double signed_distance = signedDistance(surface, cube.surface, pose).distance;
    if (!is_inside) {
      EXPECT_GT(signed_distance, 0.0);
      continue;
    }
    EXPECT_TRUE(found.is_known);
    EXPECT_NEAR(signed_distance, -found.depth, tolerance);
    // The witness shows that the depth is not too great, and a grid that it is not too small.
    EXPECT_NEAR(defective.distanceToBoundary(found.point_on_b), found.depth, tolerance);
    for (const Vec3& point : pointsOn(half))
      EXPECT_LT(defective.distanceToBoundary(pose * point), found.upper_bound + tolerance);
  }
  return count;
}

/// Expects a mesh that is pressed into a large block to be as deep in it as its lowest vertex.
void checkPressed(const DefectiveMesh& defective, const Surface& surface) {
  const double size = defective.size(), tolerance = 1e-6 * size + 2.0 * defective.gap;
  const Solid block(testing::boxMesh(Vec3::Constant(10.0 * size)));
  std::mt19937_64 random(202);
  DepthQuery query;
  for (const double height : {0.3, 0.01, -0.01, -0.3}) {
    Pose pose{testing::randomRotation(random), testing::randomPoint(random, size)};
    pose.translation.z() = 0.0;
    pose.translation.z() = (10.0 + height) * size - testing::lowestZ(*defective.mesh, pose);
    const GougeDepth found = query.deepest(block.surface, surface, pose, 1e-8 * size);
    EXPECT_EQ(found.gouging, height < 0.0 ? Gouging::found : Gouging::none);
    EXPECT_NEAR(found.depth, std::max(0.0, -height * size), tolerance);
    EXPECT_NEAR(signedDistance(block.surface, surface, pose).distance, height * size, tolerance);
    EXPECT_NEAR(signedDistance(surface, block.surface, pose.inverse()).distance, height * size, tolerance);
  }
}

/// Expects each triangle to have a role that occurs on it, by winding numbers on both sides.
void checkRoles(const DefectiveMesh& defective, const Surface& surface) {
  const TriangleMesh& mesh = *defective.mesh;
  const SharedMesh single = testing::withoutCopies(mesh);
  const double step = 1e-8 * sizeOf(defective);
  std::vector<double> bounding(mesh.triangleCount(), 0.0);  // the area that is part of the boundary
  for (std::uint32_t t = 0; t < surface.boundary().mesh().triangleCount(); ++t)
    bounding[surface.sourceOf(t)] += scaledNormal(surface.boundary().mesh().triangle(t)).norm();
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const Triangle triangle = mesh.triangle(t);
    const Vec3 normal = unitNormal(triangle);
    if (scaledNormal(triangle).norm() < 1e-12 * sizeOf(defective) * sizeOf(defective)) continue;
    std::array<bool, 4> occurs{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; i + j < 3; ++j) {
        const Vec3 point = triangle[0] + (0.07 + 0.4 * i) * (triangle[1] - triangle[0]) +
                           (0.08 + 0.4 * j) * (triangle[2] - triangle[0]);
        const bool before = std::abs(testing::preciseWindingNumber(*single, point + step * normal)) > 0.5,
                   behind = std::abs(testing::preciseWindingNumber(*single, point - step * normal)) > 0.5;
        const TriangleRole role = before ? (behind ? TriangleRole::inner : TriangleRole::inward)
                                         : (behind ? TriangleRole::outward : TriangleRole::sheet);
        occurs[static_cast<std::size_t>(role)] = true;
      }
    }
    if (occurs[static_cast<std::size_t>(surface.role(t))]) continue;
    // The role may be that of a small part, if the rest is inner.
    EXPECT_LT(bounding[t], 0.05 * scaledNormal(triangle).norm())
        << t << ' ' << static_cast<int>(surface.role(t));
    EXPECT_TRUE(occurs[static_cast<std::size_t>(TriangleRole::inner)]) << t;
  }
}

void checkAll(const DefectiveMesh& defective, int points, int probes) {
  SCOPED_TRACE(defective.name);
  const Solid solid(defective.mesh);
  EXPECT_EQ(solid.surface.isClosed(), defective.is_closed);
  EXPECT_EQ(solid.surface.isWhole(), defective.is_whole);
  const PointCount count = checkLocations(defective, solid.surface, points);
  EXPECT_LT(count.skipped, points / 50);
  const bool is_usual = defective.clean && defective.is_faithful;
  EXPECT_GT(count.inside, (is_usual ? 30 : 15) * points / 100);
  EXPECT_LT(count.inside, (is_usual ? 70 : 75) * points / 100);
  if (!defective.is_faithful) return;
  checkMass(defective, solid.surface);
  if (!defective.is_closed) return;
  EXPECT_EQ(count.not_true, 0);
  checkRoles(defective, solid.surface);
  checkPressed(defective, solid.surface);
  const ProbeCount of_probes = checkProbes(defective, solid.surface, probes);
  if (probes < 40) return;
  EXPECT_GT(of_probes.inside, probes / 30);
  EXPECT_GT(of_probes.outside, probes / 30);
  EXPECT_GT(of_probes.touching, probes / 30);
}

TEST(Defects, alone) {
  for (const DefectiveMesh& defective : testing::defectiveMeshes()) checkAll(defective, 2000, 80);
}

constexpr std::size_t kShares = 12;

class TwoDefects : public ::testing::TestWithParam<std::size_t> {};

TEST_P(TwoDefects, inOneMesh) {
  const std::vector<DefectiveMesh> all = testing::twiceDefectiveMeshes();
  EXPECT_GT(all.size(), 150u);
  for (std::size_t i = GetParam(); i < all.size(); i += kShares) checkAll(all[i], 2000, 80);
}

INSTANTIATE_TEST_SUITE_P(Defects, TwoDefects, ::testing::Range(std::size_t{0}, kShares));

/// Everything that a surface tells of a mesh, to the last bit.
std::vector<double> answersOf(const DefectiveMesh& defective, int threads) {
  const ClusteredOctree tree = ClusteredOctree::build(defective.mesh, {.threads = threads});
  const Surface surface(tree, threads);
  std::vector<double> answers = {static_cast<double>(surface.isClosed()),
                                 static_cast<double>(surface.isWhole())};
  const auto add = [&](const Vec3& vector) { answers.insert(answers.end(), vector.begin(), vector.end()); };
  for (std::uint32_t t = 0; t < defective.mesh->triangleCount(); ++t)
    answers.push_back(static_cast<double>(surface.role(t)));
  const TriangleMesh& boundary = surface.boundary().mesh();
  for (const Vec3& vertex : boundary.vertices()) add(vertex);
  for (const auto& corners : boundary.triangles())
    answers.insert(answers.end(), corners.begin(), corners.end());
  const MassProperties mass = massProperties(surface);
  answers.push_back(mass.volume);
  add(mass.center_of_mass);
  for (int k = 0; k < 3; ++k) add(mass.inertia.col(k));
  const ClusteredOctree box =
      ClusteredOctree::build(testing::boxMesh(Vec3::Constant(0.1 * sizeOf(defective))));
  const Surface box_surface(box, threads);
  DepthQuery query;
  std::mt19937_64 random(204);
  for (int i = 0; i < 40; ++i) {
    const Vec3 point = samplePoint(random, *defective.mesh);
    answers.push_back(static_cast<double>(locate(surface, point)));
    answers.push_back(windingNumber(surface, point));
    const Pose pose{testing::randomRotation(random), point};
    answers.push_back(static_cast<double>(containment(surface, box_surface, pose)));
    const GougeDepth depth = query.deepest(surface, box_surface, pose, 1e-4 * sizeOf(defective));
    answers.insert(answers.end(), {depth.depth, depth.upper_bound, static_cast<double>(depth.triangle_a)});
    add(depth.point_on_a);
  }
  return answers;
}

TEST(Defects, answersAreTheSameForOneThreadAndForThree) {
  for (const DefectiveMesh& defective : testing::defectiveMeshes())
    EXPECT_EQ(answersOf(defective, 1), answersOf(defective, 3)) << defective.name;
}

/// The case that led to these tests: depth 0 and distance +0.9, because the facets of the cube were there
/// twice.
TEST(Defects, aCubeInACubeWhoseFacetsAreThereSeveralTimes) {
  const SharedMesh cube = testing::boxMesh({1, 1, 1});
  const SharedMesh twice = testing::joined(*cube, *cube);
  const Solid small(testing::boxMesh({0.1, 0.1, 0.1})),
      small_twice(testing::joined(*small.mesh, *small.mesh));
  DepthQuery query;
  for (const SharedMesh& mesh :
       {cube, twice, testing::joined(*twice, *cube), testing::joined(*twice, *twice)}) {
    const Solid large(mesh);
    for (const Solid* inner : {&small, &small_twice}) {
      EXPECT_NEAR(signedDistance(large.surface, inner->surface, {}).distance, -0.9, 1e-6);
      EXPECT_NEAR(signedDistance(inner->surface, large.surface, {}).distance, -0.9, 1e-6);
      EXPECT_NEAR(query.deepest(large.surface, inner->surface, {}, 1e-7).depth, 0.9, 1e-6);
      EXPECT_EQ(containment(large.surface, inner->surface, {}), Containment::b_inside_a);
    }
  }
}

TEST(Defects, moved) {
  std::mt19937_64 random(203);
  for (const DefectiveMesh& defective : testing::defectiveMeshes()) {
    for (const double scale : {1.0, 1e-3, 1e3})
      checkAll(testing::moved(defective, testing::randomPose(random, 3.0 * scale), scale), 300, 10);
  }
}

}  // namespace
}  // namespace octoblisk
