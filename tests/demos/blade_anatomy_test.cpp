#include "models/blade_anatomy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "demos/block.h"
#include "demos/command.h"
#include "demos/moved_blisk.h"
#include "demos/refusal.h"
#include "demos/scratch_folder.h"
#include "models/belt_grinder.h"
#include "models/blisk_axis.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

double radius(const Vec3& point) { return std::hypot(point.x(), point.y()); }
double angle(const Vec3& point) { return std::atan2(point.y(), point.x()); }

/// The point of a triangle at a place of the meridian (z, radius); none if the triangle does not reach it.
std::optional<Vec3> atMeridian(const Triangle& t, double z, double r) {
  Vec3 weights;
  for (int k = 0; k < 3; ++k) {
    const Vec3& a = t[(k + 1) % 3];
    const Vec3& b = t[(k + 2) % 3];
    weights[k] = (a.z() - z) * (radius(b) - r) - (radius(a) - r) * (b.z() - z);
  }
  const double sum = weights.sum();
  if (sum == 0.0 || (weights / sum).minCoeff() <= 0.0) return std::nullopt;
  weights /= sum;
  return weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
}

/// The true side of some triangles of a generated blade: the side on which no other triangle of the blade
/// lies beyond it at the same z and radius.
std::map<std::size_t, BladePart> trueParts(const Blisk& blisk, int blade, double tip_radius, bool shroud) {
  std::vector<std::size_t> of_blade;
  for (std::size_t t = 0; t < blisk.mesh.triangleCount(); ++t) {
    if (blisk.blade_of_triangle[t] == blade) of_blade.push_back(t);
  }
  std::map<std::size_t, BladePart> parts;
  for (const std::size_t t : of_blade) {
    const Triangle corners = blisk.mesh.triangle(t);
    const double least_radius = std::min({radius(corners[0]), radius(corners[1]), radius(corners[2])});
    if (!shroud && least_radius > tip_radius - 1e-6) {
      parts[t] = BladePart::tip;
      continue;
    }
    const Vec3 center = centroidOf(corners);
    for (const std::size_t other : of_blade) {
      if (other == t) continue;
      const auto opposite = atMeridian(blisk.mesh.triangle(other), center.z(), radius(center));
      if (!opposite) continue;
      const double ahead = std::remainder(angle(center) - angle(*opposite), 2.0 * std::numbers::pi);
      parts[t] = ahead > 0.0 ? BladePart::forward : BladePart::backward;
    }
  }
  return parts;
}

/// Whether the middle section bulges to its forward side: the mean offset of its points from the chord.
bool forwardIsConvex(const SectionLoop& loop) {
  const auto by_z = [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); };
  const Vec3 leading = *std::min_element(loop.begin(), loop.end(), by_z);
  const Vec3 trailing = *std::max_element(loop.begin(), loop.end(), by_z);
  double offset = 0.0;
  for (const Vec3& point : loop) {
    const double part = (point.z() - leading.z()) / (trailing.z() - leading.z());
    offset += angle(point) - std::lerp(angle(leading), angle(trailing), part);
  }
  return offset > 0.0;
}

Vec3 extremeOf(const SectionLoop& loop, bool greatest) {
  const auto by_z = [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); };
  return greatest ? *std::max_element(loop.begin(), loop.end(), by_z)
                  : *std::min_element(loop.begin(), loop.end(), by_z);
}

class Anatomy : public ::testing::TestWithParam<std::pair<unsigned, bool>> {
 protected:
  const RandomBlisk truth_ = randomBlisk(GetParam().first, GetParam().second);
};

TEST_P(Anatomy, findsTheAxisWhereverTheBliskLies) {
  const BliskFound found = findBlisk(truth_.mesh);
  const Vec3 direction = truth_.blisk_in_mesh.rotation.col(2);
  EXPECT_NEAR(std::abs(found.axis.direction.dot(direction)), 1.0, 1e-12) << truth_.name;
  EXPECT_LT((found.axis.point - truth_.blisk_in_mesh.translation).cross(direction).norm(), 1e-6);
  EXPECT_LT(found.repeat_error, 1e-6);
  const int count = *std::ranges::max_element(truth_.blisk.blade_of_triangle);
  ASSERT_EQ(found.blades.count, count);
  EXPECT_EQ(found.blades.shrouded, GetParam().second);

  // The numbers run in the generator's direction, or in the opposite one if the axis is reversed, from any
  // blade.
  const bool reversed = found.axis.direction.dot(direction) < 0.0;
  std::map<int, std::map<int, int>> met;
  for (std::size_t t = 0; t < truth_.mesh.triangleCount(); ++t) {
    const int expected = truth_.blisk.blade_of_triangle[t];
    const int actual = found.blades.blade_of_triangle[t];
    if (expected != 0 && actual != 0) ++met[expected][actual];
    EXPECT_FALSE(expected == 0 && actual != 0);
  }
  for (int blade = 1; blade <= count; ++blade) {
    ASSERT_EQ(met[blade].size(), 1u) << "all its triangles have one number";
    const int here = met[blade].begin()->first;
    const int next = met[blade % count + 1].begin()->first;
    EXPECT_EQ((next - here + count) % count, reversed ? count - 1 : 1);
  }
}

TEST_P(Anatomy, findsTheSidesAsTheyLie) {
  const BliskFound found = findBlisk(truth_.blisk.mesh);
  const BliskAnatomy anatomy = findAnatomy(truth_.blisk.mesh, found.blades);
  EXPECT_TRUE(anatomy.sides.faces_outward);
  for (const int blade : {1, found.blades.count}) {
    const auto parts = trueParts(truth_.blisk, blade, found.blades.tip_radius, GetParam().second);
    ASSERT_GT(parts.size(), 300u);
    double wrong = 0.0, whole = 0.0;
    for (const auto& [t, part] : parts) {
      const double area = scaledNormal(truth_.blisk.mesh.triangle(t)).norm();
      whole += area;
      if (anatomy.sides.part_of_triangle[t] != part) wrong += area;
      EXPECT_EQ(anatomy.sides.blade_of_triangle[t], blade);
    }
    EXPECT_LT(wrong, 0.002 * whole) << truth_.name;
  }
}

TEST_P(Anatomy, convexSidesEdgesAndAreasDoNotDependOnWhereTheBliskLies) {
  const BliskFound found = findBlisk(truth_.mesh);
  const TriangleMesh blisk = moved(truth_.mesh, found.mesh_in_blisk);
  const BliskAnatomy anatomy = findAnatomy(blisk, found.blades);
  const bool reversed = found.axis.direction.dot(truth_.blisk_in_mesh.rotation.col(2)) < 0.0;
  const bool forward_convex =
      forwardIsConvex(truth_.sections.loops[truth_.sections.loops.size() / 2]) != reversed;
  ASSERT_TRUE(anatomy.convex_side);
  EXPECT_EQ(*anatomy.convex_side, forward_convex ? BladeSide::forward : BladeSide::backward);

  // The generator's blade 1 is where its sections are.
  const Pose blisk_in_truth = truth_.blisk_in_mesh.inverse() * found.mesh_in_blisk.inverse();
  const Vec3 leading_tip = extremeOf(truth_.sections.loops.back(), false);
  int fitting = 0;
  for (const BladeAnatomy& blade : anatomy.blades) {
    const auto& leading = reversed ? blade.trailing : blade.leading;
    const auto& trailing = reversed ? blade.leading : blade.trailing;
    if ((blisk_in_truth * leading.back() - leading_tip).norm() > 1.0) continue;
    ++fitting;
    constexpr double kWithin = 1e-3;  // mm
    EXPECT_LT((blisk_in_truth * leading.back() - leading_tip).norm(), kWithin);
    EXPECT_LT((blisk_in_truth * trailing.back() - extremeOf(truth_.sections.loops.back(), true)).norm(),
              kWithin);
    EXPECT_LT((blisk_in_truth * leading.front() - extremeOf(truth_.sections.loops.front(), false)).norm(),
              kWithin);
    EXPECT_LT((blisk_in_truth * trailing.front() - extremeOf(truth_.sections.loops.front(), true)).norm(),
              kWithin);
  }
  EXPECT_EQ(fitting, 1);
  const BliskAnatomy still = findAnatomy(truth_.blisk.mesh, findBlisk(truth_.blisk.mesh).blades);
  const double forward = reversed ? still.blades[0].backward_area : still.blades[0].forward_area;
  EXPECT_NEAR(anatomy.blades[0].forward_area, forward, 1e-3 * forward);
  EXPECT_NEAR(anatomy.blades[0].channel_width, still.blades[0].channel_width,
              1e-3 * still.blades[0].channel_width);
}

INSTANTIATE_TEST_SUITE_P(Seeded, Anatomy,
                         ::testing::Values(std::pair{1u, false}, std::pair{2u, false}, std::pair{3u, true},
                                           std::pair{4u, false}, std::pair{5u, true}, std::pair{6u, true}));

TEST(BladeAnatomy, mirroredBladesAreConvexOnTheOtherSide) {
  const Blisk blisk = makeDefaultBlisk(10'000);
  std::vector<Vec3> vertices = blisk.mesh.vertices();
  for (Vec3& vertex : vertices) vertex.y() = -vertex.y();
  std::vector<TriangleMesh::Indices> triangles = blisk.mesh.triangles();
  for (TriangleMesh::Indices& corners : triangles) std::swap(corners[1], corners[2]);
  const TriangleMesh mirrored(vertices, triangles);
  const auto convexOf = [](const TriangleMesh& mesh) {
    return findAnatomy(mesh, findBlades(mesh)).convex_side.value();
  };
  EXPECT_NE(convexOf(blisk.mesh), convexOf(mirrored));
  const TriangleMesh inward(vertices, blisk.mesh.triangles());
  EXPECT_EQ(convexOf(inward), convexOf(mirrored)) << "whatever side the triangles face";
}

TEST(BladeAnatomy, straightBladesHaveNoConvexSide) {
  BladeParameters straight;
  straight.camber_hub = straight.camber_tip = 0.0;
  BliskOptions options;
  options.target_triangles = 15'000;
  const Blisk blisk = makeBlisk(makeBladeSections(straight), cylinderProfile(128.0, 100.0), options);
  EXPECT_FALSE(findAnatomy(blisk.mesh, findBlades(blisk.mesh)).convex_side);
}

TEST(BladeAnatomy, theChannelIsAsWideAsBruteForceSays) {
  const Blisk blisk = makeDefaultBlisk(20'000);
  const BliskAnatomy anatomy = findAnatomy(blisk.mesh, findBlades(blisk.mesh));
  std::vector<Vec3> here, there;  // at about mid height
  for (std::size_t t = 0; t < blisk.mesh.triangleCount(); ++t) {
    const Vec3 center = centroidOf(blisk.mesh.triangle(t));
    if (std::abs(radius(center) - 188.0) > 5.0) continue;
    if (blisk.blade_of_triangle[t] == 3) here.push_back(center);
    if (blisk.blade_of_triangle[t] == 4) there.push_back(center);
  }
  ASSERT_GT(std::min(here.size(), there.size()), 20u);
  double least = 1e9;
  for (const Vec3& a : here) {
    for (const Vec3& b : there) least = std::min(least, (a - b).norm());
  }
  EXPECT_NEAR(anatomy.blades[2].channel_width, least, 0.05 * least)
      << "it changes with the radius, and centroids lie apart";
  EXPECT_NEAR(anatomy.blades[2].channel_width, anatomy.blades[23].channel_width, 1e-3 * least);
}

TEST(BladeAnatomy, heightsRiseFromTheHubToTheTip) {
  const Blisk blisk = makeDefaultBlisk(20'000);
  const BladesFound found = findBlades(blisk.mesh);
  const BladeContours contours(blisk.mesh, findBladeSides(blisk.mesh, found), 7);
  double before = 0.0;
  for (const double height : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    const BladeContour contour = contours.at(height);
    double sum = 0.0, least = 1e9, greatest = 0.0;
    for (const ContourPoint& point : contour.forward) {
      sum += radius(point.position);
      least = std::min(least, radius(point.position));
      greatest = std::max(greatest, radius(point.position));
      EXPECT_NEAR(point.normal.norm(), 1.0, 1e-12);
    }
    EXPECT_GT(sum / static_cast<double>(contour.forward.size()), before);
    before = sum / static_cast<double>(contour.forward.size());
    EXPECT_LT(greatest - least, 8.0) << "lines of equal height keep their radius approximately";
    EXPECT_EQ(contour.forward.front().position, contour.backward.front().position);
    EXPECT_EQ(contour.forward.back().position, contour.backward.back().position);
  }
  EXPECT_NEAR(before, 240.0, 1e-3);
}

TEST(BliskAxis, refusesWhatIsNoBlisk) {
  const auto refusal = [](const TriangleMesh& mesh) {
    return messageOf<std::invalid_argument>([&] { findBlisk(mesh); });
  };
  EXPECT_THAT(refusal(*testing::torus(100.0, 30.0, 60, 30)), HasSubstr("no blades"));
  EXPECT_THAT(refusal(block({50.0, 40.0, 20.0}, 4)), HasSubstr("no blades"));
  EXPECT_THAT(refusal(makeArm()), HasSubstr("no blades"));
  EXPECT_THAT(refusal(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})), HasSubstr("no blades"));
  EXPECT_THAT(refusal(TriangleMesh({{0, 0, 0}}, {{0, 0, 0}})), HasSubstr("no blades"));
  const Blisk whole = makeDefaultBlisk(10'000);
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < whole.mesh.triangleCount(); ++t) {
    if (whole.blade_of_triangle[t] != 7) triangles.push_back(whole.mesh.triangles()[t]);
  }
  refusal(TriangleMesh(whole.mesh.vertices(), std::move(triangles)));
}

TEST(BliskAxis, refusesBladesThatDoNotRepeat) {
  // One blade is swollen along Z: similar enough to be counted, but its neighbour does not match it after
  // rotation.
  const Blisk blisk = makeDefaultBlisk(10'000);
  std::vector<Vec3> vertices = blisk.mesh.vertices();
  std::vector<bool> of_one(vertices.size(), false);
  for (std::size_t t = 0; t < blisk.mesh.triangleCount(); ++t) {
    if (blisk.blade_of_triangle[t] != 5) continue;
    for (const std::uint32_t v : blisk.mesh.triangles()[t]) of_one[v] = true;
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double above_hub = radius(vertices[v]) - 128.0;
    if (of_one[v]) vertices[v].z() += 0.05 * above_hub;
  }
  EXPECT_THAT(messageOf<std::invalid_argument>([&] {
                findBlisk({vertices, blisk.mesh.triangles()});
              }),
              HasSubstr("off"));
}

TEST(BliskAxis, takesTheGivenAxis) {
  const RandomBlisk truth = randomBlisk(2, false);
  const Vec3 direction = -3.0 * truth.blisk_in_mesh.rotation.col(2);
  const BliskFound found = findBlisk(truth.mesh, {direction, truth.blisk_in_mesh * Vec3(0.0, 0.0, 77.0)});
  EXPECT_TRUE(found.axis.direction.isApprox(direction / 3.0, 1e-12));
  EXPECT_GT(found.blades.count, 0);
  EXPECT_LT(found.repeat_error, 1e-6);
  messageOf<std::invalid_argument>([&] { findBlisk(truth.mesh, {truth.blisk_in_mesh.rotation.col(0), {}}); });
  messageOf<std::invalid_argument>([&] { findBlisk(truth.mesh, {Vec3::Zero(), {}}); });
}

class BladesCommand : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), "blades " + arguments); }
  ScratchFolder folder_;
};

TEST_F(BladesCommand, writesALineABladeAndAPicture) {
  const Outcome outcome = run("--out found");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("24 blades about the axis (0, 0, 1)"));
  const std::string table = contentOf(folder_.path() / "found/blades.csv");
  EXPECT_EQ(std::ranges::count(table, '\n'), 25);
  EXPECT_NEAR(std::stod(table.substr(table.find("\n24,") + 4)), 345.0, 1e-4) << "degrees";
  EXPECT_TRUE(contentOf(folder_.path() / "found/blades.png").starts_with("\x89PNG"));
}

TEST_F(BladesCommand, refusesInOneLineWhatItCannotFind) {
  ASSERT_EQ(runOctoblisk(folder_.path(), "make arm --out arm.ply").exit_code, 0);
  ASSERT_EQ(runOctoblisk(folder_.path(),
                         "make blisk --triangles 15000 --camber-hub 0 --camber-tip 0 --out straight.ply")
                .exit_code,
            0);
  const std::pair<const char*, const char*> cases[] = {
      {"--blisk missing.stl --out run", "missing.stl"},
      {"--blisk arm.ply --out run", "arm.ply: no blades"},
      {"--blisk arm.ply --axis 1,0,0 --out run", "arm.ply: no blades"},
      {"--axis 1,0,0 --out run", "no blades were found about the given axis"},
      {"--axis 0,0,0 --out run", "--axis"},
      {"--axis 0,0,1,5 --out run", "--axis"},
      {"--axis 0,nan,1 --out run", "--axis"},
      {"--axis 0,0,1, --out run", "--axis"},
      {"--blisk straight.ply --out run", "straight.ply: the blades are too straight"}};
  for (const auto& [arguments, named] : cases) {
    expectRefusal(run(arguments), named);
  }
  EXPECT_EQ(run("--blisk straight.ply --convex forward --axis 0,0,-1 --no-picture --out run").exit_code, 0);
}

}  // namespace
}  // namespace octoblisk::demos
