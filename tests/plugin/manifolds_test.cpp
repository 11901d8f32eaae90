#include "manifolds.h"

#include <btBulletCollisionCommon.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "octoblisk_bullet/convert.h"

namespace octoblisk {
namespace {

using namespace detail;

/// A patch of one contact at the origin of the mesh, whose normal is turned by some degrees from z.
ContactPatch sideOfGroove(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  ContactPatch patch;
  patch.contacts[0].normal = Vec3(std::sin(angle), 0, std::cos(angle));
  patch.count = 1;
  return patch;
}

/// The two sides of a groove touch at the same place. Each keeps its manifold, and with it its impulse.
TEST(Manifolds, patchesAtOnePlaceKeepTheManifoldsOfTheirNormals) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  for (const bool mesh_is_body1 : {false, true}) {
    btSphereShape shape(1);
    btCollisionObject body0, body1;
    body0.setCollisionShape(&shape);
    body1.setCollisionShape(&shape);
    Manifolds manifolds(dispatcher, &body0, &body1);
    const PatchesMesh mesh{{Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized()).toRotationMatrix(), {4, 5, 6}},
                           {Mat3::Identity(), {4, 5, 6}},
                           0.0,
                           mesh_is_body1};
    std::vector<ContactPatch> sides = {sideOfGroove(20), sideOfGroove(-20)};
    manifolds.match(sides, mesh, btScalar(0.02));
    for (std::size_t side = 0; side < 2; ++side) {
      const Vec3 to_mesh = mesh.in_world.rotation * sides[side].contacts[0].normal;
      manifolds.of(side)->addManifoldPoint(
          {btVector3(0, 0, 0), btVector3(0, 0, 0), toBullet(mesh_is_body1 ? Vec3(-to_mesh) : to_mesh), 0});
    }
    const btPersistentManifold *first = manifolds.of(0), *second = manifolds.of(1);
    manifolds.match(sides, mesh, btScalar(0.02));
    EXPECT_EQ(manifolds.of(0), first);
    EXPECT_EQ(manifolds.of(1), second);
    std::swap(sides[0], sides[1]);
    manifolds.match(sides, mesh, btScalar(0.02));
    EXPECT_EQ(manifolds.of(0), second);
    EXPECT_EQ(manifolds.of(1), first);
  }
}

}  // namespace
}  // namespace octoblisk
