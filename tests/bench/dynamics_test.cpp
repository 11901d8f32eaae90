// The dynamics suite: its scenes run, and its measurements are correct.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "dynamics/measure.h"
#include "dynamics/scenes.h"
#include "octoblisk/mass_properties.h"

namespace octoblisk::bench {
namespace {

/// Boxes of half a metre, with a plane if the scene has one.
class Boxes final : public DynamicsScene {
 public:
  explicit Boxes(const std::vector<Vec3>& places, bool has_plane = true)
      : DynamicsScene(ShapeKind::octoblisk) {
    if (has_plane) addPlane(10.0);
    const Solid& solid = keepMoving(shapes::boxMesh(Vec3::Constant(kHalf)));
    auto& shape = keepShape<btBoxShape>(toBullet(Vec3::Constant(kHalf)));
    for (const Vec3& place : places) add(shape, solid, 2, placed(place));
  }

  const btRigidBody& body(std::size_t i) const { return *moving()[i].body; }

  static constexpr double kHalf = 0.25;

 private:
  bool isLost(const Body& body) const override { return body.pose().translation.z() < 0.0; }
};

TEST(Dynamics, everySceneRunsWithEveryShape) {
  ASSERT_GE(dynamicsEntries().size(), 8u);
  for (const DynamicsEntry& entry : dynamicsEntries()) {
    for (const ShapeKind kind : entry.kinds) {
      const auto scene = entry.make(kind, entry.quick.bodies);
      const double at_rest = scene->kineticEnergy();
      const Row row = measured(*scene, entry.quick.steps);
      SCOPED_TRACE(entry.name + ", " + nameOf(kind) + ": " + row.dump());
      EXPECT_EQ(at_rest, 0.0);
      EXPECT_EQ(scene->bodies(), entry.quick.bodies);
      EXPECT_LE(row["lost"].get<int>(), entry.quick.bodies / 10);
      EXPECT_GT(row["points"].get<int>(), 0);
      EXPECT_GE(row["points"].get<int>(), row["manifolds"].get<int>());
      EXPECT_GT(row["step_ms"].get<double>(), 0.0);
      EXPECT_EQ(row["awake_step_ms"], row["step_ms"]);  // none is asleep
      EXPECT_GT(row["late_energy_j"].get<double>(), 0.0);
      EXPECT_LT(row["depth_m"].get<double>(), 0.1);
      EXPECT_TRUE(row["asleep_after_steps"].is_null());
      EXPECT_EQ(row["time_s"].size(), 30u);
      EXPECT_EQ(row["energy_j"].size(), 30u);
      EXPECT_EQ(row["depth_over_time_m"].size(), 30u);
    }
  }
}

TEST(Dynamics, towersOfTenStandOnTriangles) {
  const auto towers = makeTowers(ShapeKind::octoblisk, 80);
  for (int step = 0; step < 1200; ++step) towers->step();
  EXPECT_EQ(towers->lost(), 0);
  EXPECT_EQ(towers->asleep(), 0);
}

TEST(Dynamics, theSameRunTwice) {
  const auto first = makeMixedPile(ShapeKind::octoblisk, 8), second = makeMixedPile(ShapeKind::octoblisk, 8);
  for (int step = 0; step < 60; ++step) {
    first->step();
    second->step();
  }
  EXPECT_EQ(first->kineticEnergy(), second->kineticEnergy());
}

/// Falls of 1 kg and 2 kg, in metres and in millimetres: m (g t)² / 2.
TEST(Dynamics, energyIsThatOfTheFall) {
  const auto pile = makeTeddyPile(ShapeKind::octoblisk, 5);
  Boxes boxes({{0, 0, 3}});
  const auto blisk = makeHullsOnBlisk(ShapeKind::bvh, 7);
  for (int step = 0; step < 6; ++step) {
    pile->step();
    boxes.step();
    blisk->step();
  }
  const double speed = 9.81 * 0.1;
  EXPECT_NEAR(pile->kineticEnergy(), 5 * 0.5 * speed * speed, 1e-4);
  EXPECT_NEAR(boxes.kineticEnergy(), speed * speed, 1e-5);
  EXPECT_NEAR(blisk->kineticEnergy(), 7 * 0.5 * 0.01 * speed * speed / 16.0, 1e-6);
}

TEST(Dynamics, depthIsThatOfTheMeshes) {
  EXPECT_EQ(Boxes({{0, 0, 0.251}, {1, 0, 0.251}}).depth(), 0.0);
  EXPECT_NEAR(Boxes({{0, 0, 0.2}}).depth(), 0.05, 1e-3);                  // in the plane
  EXPECT_NEAR(Boxes({{0, 0, 1}, {0.2, 0.3, 1.42}}).depth(), 0.08, 1e-3);  // a corner in the other
  EXPECT_NEAR(Boxes({{0, 0, 0.22}, {0, 0, 0.62}}).depth(), 0.1, 1e-3);    // the deeper of two
  EXPECT_NEAR(Boxes({{0, 0, -1}}).depth(), 1.25, 1e-2);                   // entirely below the floor
}

TEST(Dynamics, bodiesThatAreLostAreCounted) {
  Boxes boxes({{0, 0, 0.5}, {1, 0, 50}}, false);
  EXPECT_EQ(boxes.lost(), 0);
  for (int step = 0; step < 60; ++step) boxes.step();
  EXPECT_EQ(boxes.lost(), 1);
  EXPECT_EQ(boxes.bodies(), 2);
}

TEST(Dynamics, tellsWhenAllSleep) {
  Boxes boxes({{0, 0, 0.25}, {1, 0, 0.25}});
  const Row row = measured(boxes, 300);
  ASSERT_TRUE(row["asleep_after_steps"].is_number()) << row;
  EXPECT_GT(row["asleep_after_steps"].get<int>(), 120);  // Bullet waits 2 s
  EXPECT_LT(row["asleep_after_steps"].get<int>(), 180);
  Boxes again({{0, 0, 0.25}, {1, 0, 0.25}}), falling({{0, 0, 30}});
  EXPECT_EQ(stepsUntilAsleep(again, 300), row["asleep_after_steps"]);
  EXPECT_TRUE(stepsUntilAsleep(falling, 100).is_null());
  EXPECT_EQ(row["asleep"], 2);
  EXPECT_EQ(row["points"], 8);
  EXPECT_EQ(row["manifolds"], 2);
  EXPECT_EQ(row["late_energy_j"], 0.0);
  EXPECT_NEAR(row["time_s"].back().get<double>(), 5.0, 1e-12);
}

TEST(Dynamics, bodiesHaveTheInertiaOfTheirSolids) {
  const Boxes boxes({{0, 0, 1}});
  const double expected = 2.0 * 2.0 / 3.0 * 0.25 * 0.25;
  EXPECT_NEAR(boxes.body(0).getLocalInertia().x(), expected, 1e-6);

  const shapes::SharedMesh profile = shapes::uProfile(0.35, 0.3, 0.12, 0.4),
                           moved = inPrincipalFrame(profile);
  const MassProperties before = massProperties(*profile), after = massProperties(*moved);
  EXPECT_GT(before.center_of_mass.norm(), 0.01);
  EXPECT_LT(after.center_of_mass.norm(), 1e-12);
  const Solid solid(moved);
  EXPECT_LT((after.inertia - Mat3(solid.moments.asDiagonal())).norm(), 1e-12);
  EXPECT_NEAR(solid.moments.sum(), before.inertia.trace(), 1e-12);
  EXPECT_EQ(inPrincipalFrame(moved), moved);
}

TEST(Dynamics, refusesShapesThatASolidCannotHave) {
  EXPECT_THROW(makeTeddyPile(ShapeKind::hulls, 1), std::logic_error);
  EXPECT_THROW(makeTeddyPile(ShapeKind::plane, 1), std::logic_error);
}

}  // namespace
}  // namespace octoblisk::bench
