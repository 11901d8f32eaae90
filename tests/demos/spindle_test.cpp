// The belt's running speed and its forces on a blisk that may turn, compared with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "demos/block.h"
#include "grinding/belt_loop.h"
#include "grinding/spindle_cell.h"
#include "models/belt_grinder.h"
#include "models/orientation.h"
#include "models/shared_tree.h"

namespace octoblisk::demos {
namespace {

TEST(BeltLoop, runsRoundTheContactWheelAndAlongTheStrands) {
  const BeltParameters belt;
  const BeltLoop loop(makeBelt());
  const double outside = belt.contact_wheel_radius + belt.thickness;
  for (const double radius : {belt.contact_wheel_radius, outside}) {  // both faces run in the same direction
    for (double angle = 1.8; angle < 4.4; angle += 0.13) {            // on the wheel, at -x
      const Vec3 normal(std::cos(angle), std::sin(angle), 0.0);
      const Vec3 ahead(normal.y(), -normal.x(), 0.0);
      EXPECT_GT(loop.directionAt(radius * normal + Vec3(0, 0, 7)).dot(ahead), 0.998) << angle;
    }
  }
  const double slope = std::asin((belt.drive_wheel_radius - belt.contact_wheel_radius) / belt.wheel_distance);
  const Vec3 upper(std::cos(slope), std::sin(slope), 0.0), lower(-std::cos(slope), std::sin(slope), 0.0);
  const Vec3 off(-std::sin(slope), std::cos(slope), 0.0);
  EXPECT_NEAR((loop.directionAt(outside * off + 120.0 * upper) - upper).norm(), 0.0, 1e-3);
  const Vec3 below(off.x(), -off.y(), 0.0), along_below(upper.x(), -upper.y(), 0.0);
  EXPECT_NEAR((loop.directionAt(outside * below + 120.0 * along_below) - lower).norm(), 0.0, 1e-3);
}

/// A drum about Z, a prism with many sides, with a boss at +x. A wider tool presses on the boss's flat top,
/// so the force goes through the axis, and no touching edge can give it another direction.
constexpr double kRadius = 100.0;  // of the boss's top
constexpr double kDrumRadius = 98.0, kHalfHeight = 10.0;

TriangleMesh drum() {
  constexpr std::uint32_t kSides = 48;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  const double corner = kDrumRadius / std::cos(std::numbers::pi / kSides);
  for (std::uint32_t k = 0; k < kSides; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.5) / kSides;
    vertices.emplace_back(corner * std::cos(angle), corner * std::sin(angle), -kHalfHeight);
    vertices.emplace_back(corner * std::cos(angle), corner * std::sin(angle), kHalfHeight);
  }
  const auto low = static_cast<std::uint32_t>(vertices.size()), high = low + 1;
  vertices.emplace_back(0, 0, -kHalfHeight);
  vertices.emplace_back(0, 0, kHalfHeight);
  for (std::uint32_t k = 0; k < kSides; ++k) {
    const std::uint32_t here = 2 * k, next = 2 * ((k + 1) % kSides);
    triangles.insert(
        triangles.end(),
        {{here, next, next + 1}, {here, next + 1, here + 1}, {low, next, here}, {high, here + 1, next + 1}});
  }
  const Vec3 half(5, 6, 2);
  const TriangleMesh boss = block(half, 1);
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const Vec3& vertex : boss.vertices()) vertices.push_back(vertex + Vec3(kRadius - half.x(), 0, 0));
  for (const auto& [a, b, c] : boss.triangles()) triangles.push_back({first + a, first + b, first + c});
  return {vertices, triangles};
}

/// A block whose face at -x, wider than the boss, acts as the belt; it is at the drum's +x, pressed in by a
/// depth.
ToolPart pad() { return {"belt", treeOf(block({4, 20, 3}, 1)), 20.0}; }
Pose pressed(double depth) { return {Mat3::Identity(), Vec3(kRadius + 4.0 - depth, 0, 0)}; }

TEST(SpindleCell, aHeldDrumFeelsStiffnessTimesDepthAndFrictionTimesRadius) {
  const TriangleMesh mesh = drum();
  const SpindleOptions options{.stiffness = 800.0, .friction = 0.25, .hold = 1e4};
  for (const double speed : {20.0, -20.0}) {
    SpindleCell cell(treeOf(mesh), Pose(), pad(), speed, options);
    for (const double depth : {0.02, 0.05}) {
      const SpindleLoad load = cell.loadAt(pressed(depth), depth).value();
      const double force = options.stiffness * depth, friction = options.friction * force;
      EXPECT_NEAR(load.normal_force, force, 0.01 * force);
      EXPECT_NEAR(load.friction_force, friction, 0.01 * friction);
      EXPECT_NEAR(load.force.x(), -force, 0.01 * force) << "towards the axis";
      const double sign = speed > 0.0 ? 1.0 : -1.0;  // the face at -x runs towards +y
      EXPECT_NEAR(load.force.y(), sign * friction, 0.01 * friction);
      EXPECT_NEAR(load.torque, sign * friction * kRadius * 1e-3, 0.01 * friction * kRadius * 1e-3);
      EXPECT_NEAR(load.acceleration, 0.0, 1e-3);
    }
  }
  SpindleCell cell(treeOf(mesh), Pose(), pad(), 20.0, options);
  EXPECT_FALSE(cell.loadAt(pressed(-1.0), 0.0));
}

TEST(SpindleCell, aFreeDrumTurnsByTorqueOverItsInertia) {
  const TriangleMesh mesh = drum();
  const SpindleOptions options{.stiffness = 800.0, .friction = 0.25, .hold = 0.0};
  SpindleCell cell(treeOf(mesh), Pose(), pad(), 20.0, options);
  const SpindleLoad load = cell.loadAt(pressed(0.05), 0.05).value();
  const double mass = options.density * enclosedVolume(mesh);            // kg
  const double inertia = 0.5 * mass * kDrumRadius * kDrumRadius * 1e-6;  // kg m²
  EXPECT_NEAR(load.acceleration, load.torque / inertia, 0.02 * load.torque / inertia);
  EXPECT_NEAR(load.torque, 0.25 * 800.0 * 0.05 * kRadius * 1e-3, 0.03 * load.torque);

  // A weaker brake lets the blisk accelerate by the remaining torque.
  SpindleOptions weak = options;
  weak.hold = 0.4 * load.torque;
  SpindleCell braked(treeOf(mesh), Pose(), pad(), 20.0, weak);
  const SpindleLoad rest = braked.loadAt(pressed(0.05), 0.05).value();
  EXPECT_NEAR(rest.acceleration, (rest.torque - weak.hold) / inertia, 0.03 * rest.torque / inertia);
}

TEST(SpindleCell, aBeltThatStandsHasNoFrictionAndTheMeshMayLieAnyhow) {
  const TriangleMesh mesh = drum();
  const SpindleOptions options{.stiffness = 800.0, .friction = 0.25, .hold = 1e4};
  SpindleCell still(treeOf(mesh), Pose(), pad(), 0.0, options);
  const SpindleLoad load = still.loadAt(pressed(0.05), 0.05).value();
  EXPECT_NEAR(load.friction_force, 0.0, 1e-6);
  EXPECT_NEAR(load.torque, 0.0, 1e-6);

  const Pose mesh_in_blisk{Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                           Vec3(30, -20, 10)};
  const Pose blisk_in_mesh = mesh_in_blisk.inverse();
  std::vector<Vec3> vertices = mesh.vertices();
  for (Vec3& vertex : vertices) vertex = blisk_in_mesh * vertex;
  const auto lying = treeOf(TriangleMesh(vertices, mesh.triangles()));
  SpindleCell moved(onSpindle(lying, mesh_in_blisk), mesh_in_blisk, pad(), 20.0, options);
  const SpindleLoad same = moved.loadAt(blisk_in_mesh * pressed(0.05), 0.05).value();
  const Vec3 force = mesh_in_blisk.rotation * same.force;
  EXPECT_NEAR(force.x(), -40.0, 0.4);
  EXPECT_NEAR(force.y(), 10.0, 0.1);
  EXPECT_NEAR(same.torque, 1.0, 0.01);
}

}  // namespace
}  // namespace octoblisk::demos
