// The meshes of the gallery, tests and benchmarks: closed, facing outward, and of the stated size.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/distance.h"
#include "octoblisk/mass_properties.h"
#include "octoblisk/surface.h"
#include "shapes/bodies.h"
#include "shapes/pegs.h"
#include "shapes/sheets.h"
#include "shapes/splines.h"
#include "shapes/threads.h"
#include "shared/message_of.h"

namespace octoblisk {
namespace {

using shapes::SharedMesh;

/// Computed here because massProperties turns inward-facing meshes around, which loses the sign.
double signedVolume(const TriangleMesh& mesh) {
  double six_times = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Triangle triangle = mesh.triangle(t);
    six_times += triangle[0].dot(triangle[1].cross(triangle[2]));
  }
  return six_times / 6.0;
}

/// Expects one closed surface of the Euler characteristic that faces outward. Returns its volume.
double volumeOfSolid(const SharedMesh& mesh, int euler_characteristic) {
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  const Surface surface(tree);
  EXPECT_TRUE(surface.isClosed());
  EXPECT_TRUE(surface.isOriented());
  EXPECT_EQ(surface.componentCount(), 1u);
  const auto triangles = static_cast<int>(mesh->triangleCount());
  EXPECT_EQ(static_cast<int>(surface.cornerCount()) - triangles / 2, euler_characteristic);
  for (std::size_t t = 0; t < mesh->triangleCount(); ++t)
    EXPECT_GT(scaledNormal(mesh->triangle(t)).norm(), 0.0) << t;
  return signedVolume(*mesh);
}

TEST(Shapes, trefoilKnot) {
  const SharedMesh knot = shapes::trefoilKnot(0.15, 0.065, 75, 10);
  EXPECT_EQ(knot->triangleCount(), 1500u);
  // Pappus: the section times the length of the curve, 2 pi times the mean of |c'|.
  double length = 0.0;
  const SharedMesh curve = shapes::trefoilKnot(0.15, 0.0, 2000, 3);
  const std::vector<Vec3>& vertices = curve->vertices();
  for (std::size_t i = 0; i < 2000; ++i) length += (vertices[3 * i] - vertices[3 * ((i + 1) % 2000)]).norm();
  const double section = 5.0 * std::sin(0.2 * std::numbers::pi) * 0.065 * 0.065;  // of a decagon
  EXPECT_NEAR(volumeOfSolid(knot, 0) / (length * section), 1.0, 0.01);
  // Every point of the tube is nearest to its own part of the curve.
  for (std::size_t v = 0; v < knot->vertices().size(); ++v) {
    for (std::size_t i = 0; i < 2000; ++i)
      ASSERT_GT((knot->vertices()[v] - vertices[3 * i]).norm(), 0.064) << v;
  }
}

/// A cut across the axis is the profile, once around; its area is the same at any height.
TEST(Shapes, threads) {
  for (const int size : {4, 8, 16, 20}) {
    const shapes::Thread thread = shapes::coarseThread(size);
    const double d = thread.diameter, length = 2.3 * d, height = 0.8 * d;
    const SharedMesh bolt = shapes::bolt(thread, length), nut = shapes::nut(thread, height);
    // Of the radius over a pitch: the flats at the crest and at the root, and the flanks between them.
    const double crest = 0.5 * d, root = crest - 0.625 * 0.5 * std::sqrt(3.0) * thread.pitch;
    const auto areaWith = [&](double wider) {
      const double r = root + wider, R = crest + wider;
      return std::numbers::pi * (R * R / 8.0 + r * r / 4.0 + 5.0 / 8.0 * (R * R + R * r + r * r) / 3.0);
    };
    const double head = std::numbers::pi * 0.64 * d * d * 0.6 * d;
    const double hexagon = 0.5 * std::sqrt(3.0) * 2.25 * d * d;
    EXPECT_NEAR(volumeOfSolid(bolt, 2) / (areaWith(0.0) * length + head), 1.0, 0.003) << size;
    EXPECT_NEAR(volumeOfSolid(nut, 0) / ((hexagon - areaWith(thread.play)) * height), 1.0, 0.003) << size;

    const ClusteredOctree bolt_tree = ClusteredOctree::build(bolt), nut_tree = ClusteredOctree::build(nut);
    const double gap = 0.5 * thread.play;                     // the flanks lean by 30° to the radius
    for (const double segments : {0.0, 96.0, 201.0, 20.3}) {  // how far the nut has been turned
      const double turn = segments / thread.segments;
      const Pose pose{Eigen::AngleAxisd(2.0 * std::numbers::pi * turn, Vec3::UnitZ()).matrix(),
                      Vec3(0, 0, turn * thread.pitch)};
      const double distance = octoblisk::distance(bolt_tree, nut_tree, pose).distance;
      const double chord = 0.5 * d * (1.0 - std::cos(std::numbers::pi / thread.segments));
      const bool are_aligned = segments == std::round(segments);
      EXPECT_NEAR(distance, turn > 0.0 ? gap : 0.0, are_aligned ? 0.06 * gap : chord) << size << ' ' << turn;
    }
    const Pose nearer{Mat3::Identity(), Vec3(0, 0, thread.pitch + 0.25 * shapes::axialPlay(thread))};
    EXPECT_NEAR(octoblisk::distance(bolt_tree, nut_tree, nearer).distance, 0.5 * gap, 0.06 * gap) << size;
  }
  EXPECT_THROW(shapes::coarseThread(7), std::invalid_argument);
}

TEST(Shapes, pegsAndHoles) {
  for (const int sides : {3, 4, 6, 96}) {
    const shapes::PegInHole fit{.sides = sides, .radius = 0.01, .clearance = 1e-4, .depth = 0.03};
    const SharedMesh peg = shapes::peg(fit, 0.04), hole = shapes::hole(fit);
    const double of_unit_radius = sides * std::tan(std::numbers::pi / sides);  // area
    EXPECT_NEAR(volumeOfSolid(peg, 2) / (of_unit_radius * 1e-4 * 0.04), 1.0, 1e-12) << sides;
    const double bore = 0.0101 * 0.0101 * 0.03, block = 0.0201 * 0.0201 * 0.04;
    EXPECT_NEAR(volumeOfSolid(hole, 2) / (of_unit_radius * (block - bore)), 1.0, 1e-12) << sides;

    const ClusteredOctree peg_tree = ClusteredOctree::build(peg), hole_tree = ClusteredOctree::build(hole);
    const auto distanceAt = [&](const Vec3& place) {
      return octoblisk::distance(hole_tree, peg_tree, {Mat3::Identity(), place}).distance;
    };
    EXPECT_EQ(distanceAt(Vec3::Zero()), 0.0) << sides;
    EXPECT_NEAR(distanceAt({0, 0, 5e-5}), 5e-5, 1e-12) << sides;  // over the floor
    EXPECT_NEAR(distanceAt({0, 0, 5e-3}), 1e-4, 1e-12) << sides;  // between the sides
    EXPECT_NEAR(distanceAt({6e-5, 0, 5e-3}), 4e-5, 1e-12) << sides;
  }
}

TEST(Shapes, pegsThatCannotBeAreRefused) {
  const shapes::PegInHole good{.sides = 4, .radius = 0.01, .clearance = 0.0, .depth = 0.03};
  const auto messageOfHole = [&](auto member, auto value) {
    shapes::PegInHole fit = good;
    fit.*member = value;
    EXPECT_THROW(shapes::peg(fit, 0.04), std::invalid_argument);
    return testing::messageOf([&] { shapes::hole(fit); });
  };
  using shapes::PegInHole;
  EXPECT_NO_THROW(shapes::hole(good));
  EXPECT_EQ(messageOfHole(&PegInHole::sides, 2), "a peg or hole cannot have the number of sides 2");
  EXPECT_EQ(messageOfHole(&PegInHole::radius, 0.0), "a peg or hole cannot have the radius 0");
  EXPECT_EQ(messageOfHole(&PegInHole::clearance, -0.5), "a peg or hole cannot have the clearance -0.5");
  EXPECT_EQ(messageOfHole(&PegInHole::depth, std::numeric_limits<double>::quiet_NaN()),
            "a peg or hole cannot have the depth nan");
  EXPECT_THROW(shapes::peg(good, 0.0), std::invalid_argument);
}

TEST(Shapes, splines) {
  for (const int teeth : {3, 6, 16}) {
    const shapes::Spline spline{
        .teeth = teeth, .root = 0.013, .tip = 0.016, .width = 0.04 / teeth, .clearance = 1e-4};
    const double length = 0.05, height = 0.03, angle = std::numbers::pi / teeth;
    const SharedMesh shaft = shapes::splineShaft(spline, length), hub = shapes::splineHub(spline, height);
    // Of a section, with all faces moved outward.
    const auto cornerWith = [&](double wider) {  // between a tooth and the ground
      return (spline.root + wider - (0.5 * spline.width + wider) * std::sin(angle)) / std::cos(angle);
    };
    const auto areaWith = [&](double wider) {  // the polygon of the ground, and the teeth at its corners
      const double root = spline.root + wider, half = 0.5 * spline.width + wider;
      const double tooth = 2.0 * half * (spline.tip + wider - cornerWith(wider));
      return teeth * ((root * root - half * half) * std::tan(angle) + tooth);
    };
    EXPECT_NEAR(volumeOfSolid(shaft, 2) / (areaWith(0.0) * length), 1.0, 1e-12) << teeth;
    const double half = 0.5 * spline.width + 1e-4, tip = spline.tip + 1e-4;
    const double to_tip = std::atan(half / tip), to_ground = std::atan(half / cornerWith(1e-4));
    const double outside =
        2.0 * teeth * (tip * tip + half * half) *
        (std::sin(2.0 * to_tip) + 2.0 * std::sin(to_ground - to_tip) + std::sin(2.0 * (angle - to_ground)));
    EXPECT_NEAR(volumeOfSolid(hub, 0) / ((outside - areaWith(1e-4)) * height), 1.0, 1e-12) << teeth;

    const ClusteredOctree shaft_tree = ClusteredOctree::build(shaft), hub_tree = ClusteredOctree::build(hub);
    for (const int turns : {0, 1, 2}) {
      const Mat3 turn = Eigen::AngleAxisd(2.0 * turns * angle, Vec3::UnitZ()).matrix();
      for (const double aside : {0.0, 6e-5}) {  // towards a tip
        const Pose pose{turn, Vec3(aside, 0, -0.01)};
        const double distance = octoblisk::distance(hub_tree, shaft_tree, pose).distance;
        EXPECT_NEAR(distance, 1e-4 - aside, 1e-12) << teeth << ' ' << turns;
      }
    }
  }
}

TEST(Shapes, splinesThatCannotBeAreRefused) {
  using shapes::Spline;
  const Spline good{.teeth = 6, .root = 13.0, .tip = 16.0, .width = 6.0, .clearance = 0.0};
  const auto messageOfHub = [&](auto member, auto value) {
    Spline spline = good;
    spline.*member = value;
    EXPECT_THROW(shapes::splineShaft(spline, 1.0), std::invalid_argument);
    return testing::messageOf([&] { shapes::splineHub(spline, 1.0); });
  };
  EXPECT_NO_THROW(shapes::splineHub(good, 1.0));
  EXPECT_EQ(messageOfHub(&Spline::teeth, 2), "a spline cannot have the number of teeth 2");
  EXPECT_EQ(messageOfHub(&Spline::width, 13.0), "a spline cannot have the width 13");
  EXPECT_EQ(messageOfHub(&Spline::tip, 13.0), "a spline cannot have the tip 13");
  EXPECT_EQ(messageOfHub(&Spline::clearance, -1.0), "a spline cannot have the clearance -1");
  EXPECT_THROW(shapes::splineShaft(good, 0.0), std::invalid_argument);
}

TEST(Shapes, jack) {
  const SharedMesh jack = shapes::jack(0.5, 0.1);
  EXPECT_EQ(jack->triangleCount(), 60u);
  EXPECT_NEAR(volumeOfSolid(jack, 2), 3 * 0.04 * 1.0 - 2 * 0.008, 1e-12);
  for (std::size_t bar = 0; bar < 3; ++bar) {
    const Aabb box = boundsOf(std::span(jack->vertices()).subspan(8 + 8 * bar, 8));
    Vec3 half = Vec3::Constant(0.1);
    half[static_cast<Eigen::Index>(bar)] = 0.5;
    EXPECT_EQ(box.halfExtents(), half);
  }
}

TEST(Shapes, teddy) {
  const SharedMesh teddy = shapes::teddy(1.0, 56);
  EXPECT_EQ(teddy->triangleCount(), 3024u);
  EXPECT_GT(volumeOfSolid(teddy, 2), 4.0 / 3.0 * std::numbers::pi * 0.3 * 0.3 * 0.3);
  EXPECT_NEAR(2.0 * teddy->bounds().halfExtents().z(), 1.0, 0.15);
}

TEST(Shapes, ellipsoidIsConvex) {
  const SharedMesh stone = shapes::ellipsoid({0.2, 0.3, 0.4}, 8);
  EXPECT_GT(volumeOfSolid(stone, 2), 0.7 * 4.0 / 3.0 * std::numbers::pi * 0.2 * 0.3 * 0.4);
  for (std::size_t t = 0; t < stone->triangleCount(); ++t) {
    const Triangle triangle = stone->triangle(t);
    for (const Vec3& vertex : stone->vertices())
      EXPECT_LT(unitNormal(triangle).dot(vertex - triangle[0]), 1e-12);
  }
}

TEST(Shapes, cylinder) {
  EXPECT_NEAR(volumeOfSolid(shapes::cylinder(0.5, 0.25, 6), 2), 6 * 0.125 * std::sqrt(0.75) * 0.5, 1e-12);
}

TEST(Shapes, whatIsBelowASheet) {
  EXPECT_NEAR(volumeOfSolid(shapes::solidBelow(*shapes::waveSheet(2.0, 0.0, 6), -0.5), 2), 8.0, 1e-12);
  EXPECT_GT(volumeOfSolid(shapes::solidBelow(*shapes::tray(5.0, 20), -1.0), 2), 100.0);
}

TEST(Shapes, scaledAndMoved) {
  const SharedMesh box = shapes::boxMesh({0.1, 0.2, 0.3}), large = shapes::scaled(*box, 10.0);
  EXPECT_NEAR(volumeOfSolid(large, 2), 8.0 * 6.0, 1e-12);
  EXPECT_EQ(shapes::moved(*large, {1, 2, 3})->bounds().center(), Vec3(1, 2, 3));
}

TEST(Shapes, bandsTorusAndBumpySphere) {
  std::mt19937_64 random(1);
  EXPECT_NEAR(volumeOfSolid(shapes::uProfile(0.35, 0.3, 0.12, 0.4), 2), 0.8 * (0.7 * 0.6 - 0.46 * 0.48),
              1e-12);
  EXPECT_GT(volumeOfSolid(shapes::gear(8, 0.4, 0.5, 0.2, 0.12), 0), 0.0);
  EXPECT_GT(volumeOfSolid(shapes::torus(0.4, 0.15, 20, 10), 0), 0.0);
  EXPECT_GT(volumeOfSolid(shapes::bumpySphere(random, 0.4, 0.15, 16), 2), 0.0);
}

}  // namespace
}  // namespace octoblisk
