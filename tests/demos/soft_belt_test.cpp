// The belt as a soft body: on its wheels, under tension, driven, and pressed against a blade.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gallery/belt_on_blade.h"
#include "models/belt_path.h"
#include "octoblisk/containment.h"

namespace octoblisk::gallery {
namespace {

/// Fewer nodes and triangles, and pressed sooner.
BeltOnBladeOptions smallOptions() {
  BeltOnBladeOptions options;
  options.blisk_triangles = 10'000;
  options.belt.stations = 160;
  options.belt.nodes_across = 4;
  options.clearance = 2.0;
  options.press_begin = 0.02;
  options.press_end = 0.08;
  return options;
}

/// The nodes around which a strand bends, and their positions in the tool's frame.
std::vector<Vec3> nodesInTool(const SoftBelt& belt) {
  const Pose world_in_tool = belt.toolInWorld().inverse();
  std::vector<Vec3> nodes;
  for (int station = 0; station < belt.stations(); ++station) {
    for (int k = 0; k < belt.nodesAcross(); ++k) nodes.push_back(world_in_tool * belt.node(station, k));
  }
  return nodes;
}

/// No station is far from the next, and the loop runs around both wheels, on their surfaces.
void expectOnWheels(const SoftBelt& belt, const SoftBeltOptions& options) {
  const double rolling = options.sizes.contact_wheel_radius + 0.5 * options.sizes.thickness,
               driving = options.sizes.drive_wheel_radius + 0.5 * options.sizes.thickness;
  const double spacing = 2.5 * (options.sizes.wheel_distance + 40.0) / options.stations;
  int on_contact_wheel = 0, on_drive_wheel = 0;
  for (int station = 0; station < belt.stations(); ++station) {
    for (int k = 0; k < belt.nodesAcross(); ++k) {
      EXPECT_LT((belt.node(station + 1, k) - belt.node(station, k)).norm(), 2.0 * spacing) << station;
    }
  }
  for (const Vec3& node : nodesInTool(belt)) {
    ASSERT_TRUE(node.allFinite());
    EXPECT_LT(std::abs(node.z()), 0.5 * options.sizes.width + 2.0);  // it does not run off
    const Vec3 from_drive = node - Vec3(options.sizes.wheel_distance, 0, 0);
    EXPECT_GT(node.head<2>().norm(), rolling - 1e-6);
    EXPECT_GT(from_drive.head<2>().norm(), driving - 1e-6);
    // The belt lies on the wheel that it wraps. The error of the chords between nodes is below the tolerance.
    if (node.x() < -0.5 * rolling) {
      EXPECT_LT(node.head<2>().norm(), rolling + 0.5);
      ++on_contact_wheel;
    }
    if (from_drive.x() > 0.5 * driving) {
      EXPECT_LT(from_drive.head<2>().norm(), driving + 0.5);
      ++on_drive_wheel;
    }
  }
  EXPECT_GE(on_contact_wheel, 2 * belt.nodesAcross());
  EXPECT_GE(on_drive_wheel, 2 * belt.nodesAcross());
}

TEST(SoftBelt, staysOnItsWheelsUnderTensionAndBendsOverTheBlade) {
  const BeltOnBladeOptions options = smallOptions();
  BeltOnBlade scene(options);
  EXPECT_EQ(scene.contacts().size(), 0u);
  EXPECT_EQ(scene.touching().size(), 0u);
  EXPECT_EQ(scene.deepestNode(), 0.0);
  const Vec3 first = scene.belt().toolInWorld().inverse() * scene.belt().node(0, 0);
  std::size_t touching_steps = 0, pressed_steps = 0, most_touching = 0;
  double deepest = 0.0;
  for (int step = 0; scene.time() < options.press_end + 0.1; ++step) {
    scene.step();
    if (scene.time() < options.press_begin) {
      EXPECT_EQ(scene.contacts().size(), 0u) << scene.time();
    }
    if (scene.time() > options.press_end) {
      ++pressed_steps;
      touching_steps += !scene.contacts().empty();
      most_touching = std::max(most_touching, scene.touching().size());
    }
    if (step % 16 != 0) continue;
    expectOnWheels(scene.belt(), options.belt);
    EXPECT_GT(scene.belt().strain().mean, 0.2 * options.belt.strain) << scene.time();
    EXPECT_NEAR(scene.belt().meanSpeed(), options.belt.speed, 0.3 * options.belt.speed) << scene.time();
    deepest = std::max(deepest, scene.deepestNode());
  }
  EXPECT_GT(pressed_steps, 10u);
  EXPECT_GT(touching_steps, pressed_steps / 2);
  EXPECT_GT(most_touching, 5u);
  // The nodes are in the middle of the belt: less than half its thickness may be in the blade.
  EXPECT_LT(deepest, 0.1);

  // The belt was driven.
  const Vec3 now = scene.belt().toolInWorld().inverse() * scene.belt().node(0, 0);
  EXPECT_GT((now - first).norm(), 10.0);

  // Without yielding, the strand would be in the blade.
  demos::BeltParameters sizes = options.belt.sizes;
  sizes.contact_wheel_radius += 0.5 * sizes.thickness;
  sizes.drive_wheel_radius += 0.5 * sizes.thickness;
  const demos::BeltPath straight(sizes);
  const Surface blisk(scene.blisk());
  int cut = 0;
  for (double length = 0.0; length < straight.length(); length += 1.0) {
    const Vec3 place = scene.belt().toolInWorld() * straight.atLength(length).point;
    cut += locate(blisk, place) == PointLocation::inside;
  }
  EXPECT_GT(cut, 5);
}

TEST(SoftBelt, refusesSizesThatMakeNoBelt) {
  BeltOnBladeOptions options = smallOptions();
  options.belt.nodes_across = 2;
  EXPECT_THROW(BeltOnBlade{options}, std::invalid_argument);
  options = smallOptions();
  options.belt.strain = 0.0;
  EXPECT_THROW(BeltOnBlade{options}, std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk::gallery
