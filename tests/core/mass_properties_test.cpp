// Compares volume, centre of mass and inertia with closed forms.
#include "octoblisk/mass_properties.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "octoblisk/surface.h"
#include "query/simple_solid.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::SharedMesh;

Mat3 boxInertia(const Vec3& half) {
  const Vec3 squares = half.cwiseAbs2();
  return Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y()).asDiagonal() *
         Mat3((1.0 / 3.0) * Mat3::Identity());
}

void expectNear(const MassProperties& found, const MassProperties& expected, double relative) {
  EXPECT_EQ(found.is_solid, expected.is_solid);
  EXPECT_NEAR(found.volume, expected.volume, relative * expected.volume);
  const double size = std::sqrt(expected.inertia.norm());
  EXPECT_LT((found.center_of_mass - expected.center_of_mass).norm(), relative * size);
  EXPECT_LT((found.inertia - expected.inertia).norm(), relative * expected.inertia.norm());
}

TEST(MassProperties, aMeshInsideOutFacesInward) {
  const auto cube = testing::boxMesh({0.9, 0.8, 0.7});
  const MassProperties outward = massProperties(*cube), inward = massProperties(*testing::insideOut(*cube));
  EXPECT_FALSE(outward.faces_inward);
  EXPECT_TRUE(inward.faces_inward);
  EXPECT_TRUE(inward.is_solid);
  EXPECT_NEAR(inward.volume, outward.volume, 1e-12);
}

TEST(MassProperties, box) {
  const Vec3 half(1, 2, 3);
  expectNear(massProperties(*testing::boxMesh(half)), {true, 48.0, Vec3::Zero(), boxInertia(half)}, 1e-14);
}

TEST(MassProperties, tetrahedron) {
  // A tetrahedron with edges a, b, c along the axes also has products of inertia.
  const double a = 1.0, b = 2.0, c = 4.0;
  const TriangleMesh mesh({{0, 0, 0}, {a, 0, 0}, {0, b, 0}, {0, 0, c}},
                          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  // About the centre of mass: ∫x² = 3a²/80, ∫xy = −ab/80, for mass 1.
  Mat3 second;
  second << 3 * a * a, -a * b, -a * c, -a * b, 3 * b * b, -b * c, -a * c, -b * c, 3 * c * c;
  second /= 80.0;
  const Mat3 inertia = second.trace() * Mat3::Identity() - second;
  const MassProperties found = massProperties(mesh);
  expectNear(found, {true, a * b * c / 6.0, Vec3(a, b, c) / 4.0, inertia}, 1e-14);
  const Vec3 about_corner = found.inertiaAbout(Vec3::Zero()).diagonal();
  EXPECT_NEAR(about_corner.x(), (b * b + c * c) / 10.0, 1e-14);
  EXPECT_NEAR(about_corner.y(), (a * a + c * c) / 10.0, 1e-14);
  EXPECT_NEAR(about_corner.z(), (a * a + b * b) / 10.0, 1e-14);
}

TEST(MassProperties, fineTorusAndSphere) {
  const double major = 3.0, minor = 1.0;
  const double axial = major * major + 0.75 * minor * minor;
  const double across = 0.5 * major * major + 0.625 * minor * minor;
  const Mat3 ring = Vec3(across, across, axial).asDiagonal();
  const double ring_volume = 2.0 * std::numbers::pi * std::numbers::pi * major * minor * minor;
  expectNear(massProperties(*testing::torus(major, minor, 400, 200)), {true, ring_volume, Vec3::Zero(), ring},
             5e-4);

  std::mt19937_64 random(1);
  const double radius = 2.0;
  const double ball_volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  expectNear(massProperties(*testing::bumpySphere(random, radius, 0.0, 200)),
             {true, ball_volume, Vec3::Zero(), 0.4 * radius * radius * Mat3::Identity()}, 1e-3);
}

TEST(MassProperties, movedTurnedScaledAndInsideOut) {
  std::mt19937_64 random(2);
  const SharedMesh mesh = testing::bumpySphere(random, 1.0, 0.4, 24);
  const MassProperties own = massProperties(*mesh);
  ASSERT_TRUE(own.is_solid);
  for (const double scale : {1e-9, 1.0, 1e6}) {
    for (int i = 0; i < 20; ++i) {
      const Pose pose = testing::randomPose(random, 10.0 * scale);
      const SharedMesh posed = testing::moved(*mesh, pose, scale);
      const MassProperties expected{
          true, own.volume * scale * scale * scale, pose * Vec3(scale * own.center_of_mass),
          scale * scale * (pose.rotation * own.inertia * pose.rotation.transpose())};
      expectNear(massProperties(*posed), expected, 1e-12);
      expectNear(massProperties(*testing::insideOut(*posed)), expected, 1e-12);
    }
  }
  // Far from the origin the vertices are coarse, but no further digits cancel.
  const MassProperties far = massProperties(*testing::moved(*mesh, {Mat3::Identity(), Vec3::Constant(1e6)}));
  EXPECT_LT((far.inertia - own.inertia).norm(), 1e-8 * own.inertia.norm());
}

TEST(MassProperties, aCavityIsTakenOff) {
  const SharedMesh outer = testing::boxMesh({2, 2, 2}), inner = testing::boxMesh({1, 1, 1});
  const Mat3 inertia = (64.0 * boxInertia({2, 2, 2}) - 8.0 * boxInertia({1, 1, 1})) / 56.0;
  expectNear(massProperties(*testing::joined(*outer, *testing::insideOut(*inner))),
             {true, 56.0, Vec3::Zero(), inertia}, 1e-13);
}

/// A part that faces inward bounds a solid like any other. If its mass counted as negative, the moments could
/// be too, and Bullet's bodies would explode.
TEST(MassProperties, aPartThatFacesInwardBesideAnotherWeighsAsMuch) {
  const SharedMesh cube = testing::boxMesh({1, 1, 1}), inward = testing::insideOut(*cube);
  for (const double apart : {2.5, 4.0}) {
    const SharedMesh pair =
        testing::joined(*cube, *testing::moved(*inward, {Mat3::Identity(), Vec3(apart, 0, 0)}));
    EXPECT_FALSE(detail::isSimpleSolid(*pair));
    const Vec3 parallel = 0.25 * apart * apart * Vec3(0, 1, 1);
    const Mat3 inertia = boxInertia({1, 1, 1}) + Mat3(parallel.asDiagonal());
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(1, 1, 1)}) {
      const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), axis).toRotationMatrix();
      expectNear(massProperties(*testing::moved(*pair, {turn, Vec3::Zero()})),
                 {true, 16.0, 0.5 * apart * turn.col(0), turn * inertia * turn.transpose()}, 1e-13);
    }
  }
}

TEST(MassProperties, noSolidMeansTheBoundingBox) {
  const SharedMesh box = testing::moved(*testing::boxMesh({1, 2, 3}), {Mat3::Identity(), Vec3(5, 0, 0)});
  const MassProperties of_box{false, 48.0, Vec3(5, 0, 0), boxInertia({1, 2, 3})};
  expectNear(massProperties(*testing::firstTriangles(*box, 11)), of_box, 1e-14);
  auto triangles = box->triangles();
  std::swap(triangles[4][1], triangles[4][2]);  // closed, but inconsistently oriented
  expectNear(massProperties(TriangleMesh(box->vertices(), triangles)), of_box, 1e-14);
  // A vertex that no triangle uses weighs nothing.
  auto vertices = box->vertices();
  vertices.push_back(Vec3::Constant(100.0));
  triangles.pop_back();
  expectNear(massProperties(TriangleMesh(vertices, triangles)), of_box, 1e-14);
  // Both sides of a square enclose nothing.
  const TriangleMesh sheet({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
                           {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}});
  const MassProperties flat = massProperties(sheet);
  EXPECT_FALSE(flat.is_solid);
  EXPECT_LT((flat.inertia - boxInertia({1, 1, 0})).norm(), 1e-15);
  const MassProperties point = massProperties(TriangleMesh({{1, 1, 1}}, {{0, 0, 0}}));
  EXPECT_EQ(point.inertia, Mat3::Zero());
  EXPECT_EQ(point.center_of_mass, Vec3(1, 1, 1));
}

TEST(MassProperties, ofASimpleSolid_vs_surface) {
  std::mt19937_64 random(3);
  int simple = 0;
  constexpr int kMeshes = 200;
  for (int i = 0; i < kMeshes; ++i) {
    SharedMesh mesh =
        i % 8 ? testing::torus(3, 1, 5 + i % 7, 4) : testing::randomVoxels(random, 3 + i % 4).mesh;
    if (i % 3 == 0) {
      const Vec3 offset = testing::randomPoint(random, 10.0);
      mesh =
          testing::joined(*mesh, *testing::moved(*testing::boxMesh({1, 1, 1}), {Mat3::Identity(), offset}));
    }
    auto triangles = mesh->triangles();
    const std::size_t victim = random() % triangles.size();
    switch (i % 7) {
      case 0:
        std::swap(triangles[victim][0], triangles[victim][2]);
        break;
      case 1:
        if (triangles.size() > 1) triangles.erase(triangles.begin() + std::ptrdiff_t(victim));
        break;
      case 2:
        triangles.push_back({triangles[victim][0], triangles[victim][0], triangles[victim][1]});
        break;
      case 3:
        triangles.push_back(triangles[victim]);
        break;
      default:
        break;
    }
    mesh = std::make_shared<const TriangleMesh>(mesh->vertices(), std::move(triangles));
    if (!detail::isSimpleSolid(*mesh)) continue;
    ++simple;
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    const Surface surface(tree);
    ASSERT_TRUE(surface.isWhole()) << i;
    expectNear(massProperties(*mesh), massProperties(surface), 1e-15);
  }
  EXPECT_GT(simple, kMeshes * 3 / 10);
  EXPECT_LT(simple, kMeshes * 7 / 10);
}

TEST(MassProperties, principalFrameIsDiagonal) {
  std::mt19937_64 random(4);
  const Vec3 half(3, 2, 1);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = testing::randomPose(random, 5.0);
    const MassProperties properties = massProperties(*testing::moved(*testing::boxMesh(half), pose));
    const PrincipalFrame frame = principalFrame(properties);
    EXPECT_LT((frame.in_mesh.translation - pose.translation).norm(), 1e-12);
    EXPECT_NEAR(frame.in_mesh.rotation.determinant(), 1.0, 1e-12);
    EXPECT_LT((frame.moments - Vec3(5, 10, 13) / 3.0).norm(), 1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(std::abs(frame.in_mesh.rotation.col(axis).dot(pose.rotation.col(axis))), 1.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace octoblisk
