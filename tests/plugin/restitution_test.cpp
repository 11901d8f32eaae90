// Compares the rise of bodies after a bounce with the closed form.
#include <gtest/gtest.h>

#include <algorithm>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletWorld;

/// The height after the first bounce, as a fraction of the drop height.
double riseAfterBounce(btCollisionShape& floor, btCollisionShape& body_shape, double half_height,
                       double restitution, int steps_a_second, double height) {
  BulletWorld world;
  world.add(floor, 0, at(0, 0, 0)).setRestitution(1);
  btRigidBody& body = world.add(body_shape, 1, at(0.13, 0.21, half_height + height));
  body.setRestitution(btScalar(restitution));
  double highest = 0.0;
  bool has_bounced = false;
  for (int step = 0; step < 3 * steps_a_second; ++step) {
    world.step(1, 1.0 / steps_a_second);
    const double speed_up = double(body.getLinearVelocity().z());
    has_bounced |= speed_up > 0.0;
    if (!has_bounced) continue;
    if (speed_up <= 0.0) break;
    highest = std::max(highest, double(body.getWorldTransform().getOrigin().z()) - half_height);
  }
  return highest / height;
}

/// On average over drop heights, bodies rise to e² of the height: within 10 %, or within 3 % of the drop
/// height, because a step of 1/60 s moves them that far.
TEST(Restitution, meanRise_vs_closedForm) {
  ClusteredOctreeShape sheet = shapeOver(testing::waveSheet(5, 0.0, 10));
  ClusteredOctreeShape ring = shapeOver(testing::torus(0.4, 0.1, 32, 16));
  btSphereShape ball(btScalar(0.3));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  struct Drop {
    btCollisionShape& floor;
    btCollisionShape& body;
    double half_height;
  };
  for (const Drop& drop : {Drop{sheet, ball, 0.3}, Drop{plane, ring, 0.1}}) {
    for (const int steps_a_second : {60, 240, 960}) {
      for (const double restitution : {0.0, 0.25, 0.5, 0.75, 0.9, 0.95}) {
        constexpr int kHeights = 24;
        double mean = 0.0;
        for (int i = 0; i < kHeights; ++i) {
          mean += riseAfterBounce(drop.floor, drop.body, drop.half_height, restitution, steps_a_second,
                                  0.5 + 0.0413 * i) /
                  kHeights;
        }
        const double expected = restitution * restitution;
        EXPECT_NEAR(mean, expected, std::max(0.1 * expected, 0.03))
            << "e " << restitution << ", " << steps_a_second << " Hz";
      }
    }
  }
}

}  // namespace
}  // namespace octoblisk
