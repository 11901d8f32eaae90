#include "toolpath/grinding_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "demos/default_blisk.h"
#include "models/blisk.h"
#include "models/radians.h"
#include "octoblisk/collide.h"

namespace octoblisk::demos {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const BladesFound& blades() {
  static const BladesFound result = findBlades(blisk().mesh);
  return result;
}

std::vector<Pose> pathOf(const GrindingPathOptions& options = {}) {
  return makeGrindingPath(blisk().mesh, blades(), options);
}

std::vector<Pose> workOf(const std::vector<Pose>& path, const GrindingPathOptions& options) {
  return {path.begin() + options.retract_poses, path.end() - options.retract_poses};
}

/// n of the docstring, from a pose: the arm leans from the tangent plane towards it.
Vec3 normalOf(const Pose& belt_in_blisk, const GrindingPathOptions& options) {
  const double lean = radians(options.lean_degrees);
  return std::sin(lean) * belt_in_blisk.rotation.col(0) + std::cos(lean) * belt_in_blisk.rotation.col(1);
}

double distanceFromAxis(const Pose& belt_in_blisk, const Vec3& point) {
  return (point - belt_in_blisk.translation).cross(belt_in_blisk.rotation.col(2)).norm();
}

/// Whether a point lies on a triangle, within a tolerance in mm.
bool liesOn(const Triangle& t, const Vec3& point, double tolerance) {
  const Vec3 normal = unitNormal(t);
  if (std::abs(normal.dot(point - t[0])) > tolerance) return false;
  for (int k = 0; k < 3; ++k) {
    const Vec3 inwards = normal.cross(t[(k + 1) % 3] - t[k]).normalized();
    if (inwards.dot(point - t[k]) < -tolerance) return false;
  }
  return true;
}

bool liesOnBlade(int blade, const Vec3& point, double tolerance) {
  for (std::size_t t = 0; t < blisk().mesh.triangleCount(); ++t) {
    if (blisk().blade_of_triangle[t] == blade && liesOn(blisk().mesh.triangle(t), point, tolerance)) {
      return true;
    }
  }
  return false;
}

ClusteredOctree treeOfBlades(const std::function<bool(int)>& takes) {
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < blisk().mesh.triangleCount(); ++t) {
    if (takes(blisk().blade_of_triangle[t])) triangles.push_back(blisk().mesh.triangles()[t]);
  }
  return ClusteredOctree::build(
      std::make_shared<const TriangleMesh>(blisk().mesh.vertices(), std::move(triangles)));
}

TEST(GrindingPath, rotationsAreOrthonormalAndRightHanded) {
  for (const Pose& pose : pathOf()) {
    EXPECT_TRUE((pose.rotation.transpose() * pose.rotation).isIdentity(1e-12));
    EXPECT_NEAR(pose.rotation.determinant(), 1.0, 1e-12);
  }
}

TEST(GrindingPath, eachWorkingPoseTouchesThePointOfItsBladeByTheDepth) {
  for (const bool forward : {true, false}) {
    GrindingPathOptions options;
    options.blade = 5;
    options.forward_side = forward;
    const std::vector<Pose> work = workOf(pathOf(options), options);
    const auto planned = static_cast<std::size_t>(options.passes * options.poses_per_pass);
    EXPECT_GE(work.size(), planned);
    EXPECT_LE(work.size(), planned + planned / 5) << "links are short";
    for (const Pose& pose : work) {
      const double reach = options.wheel_radius - options.depth;
      const Vec3 normal = normalOf(pose, options);
      const Vec3 touched = pose.translation - reach * normal;
      ASSERT_TRUE(liesOnBlade(options.blade, touched, 1e-6));
      EXPECT_NEAR(distanceFromAxis(pose, touched), reach, 1e-6);
      const Vec3 e_theta = Vec3(-touched.y(), touched.x(), 0.0).normalized();
      EXPECT_GT(forward ? normal.dot(e_theta) : -normal.dot(e_theta), 0.3) << "the requested side";
      EXPECT_GT(pose.rotation.col(0).dot(Vec3(touched.x(), touched.y(), 0.0).normalized()), 0.7)
          << "the arm goes outwards";
    }
  }
}

TEST(GrindingPath, passesKeepTheirRadiusFromTheTipInwards) {
  GrindingPathOptions options;
  options.passes = 2;
  const std::vector<Pose> work = workOf(pathOf(options), options);
  const auto radiusOfTouch = [&](const Pose& pose) {
    const Vec3 touched = pose.translation - (options.wheel_radius - options.depth) * normalOf(pose, options);
    return std::hypot(touched.x(), touched.y());
  };
  constexpr double kSagitta = 0.05;  // of the mesh's triangles
  for (int k = 0; k < options.poses_per_pass; ++k) {
    const std::size_t back = work.size() - 1 - static_cast<std::size_t>(k);
    EXPECT_NEAR(radiusOfTouch(work[k]), 128.0 + 0.97 * 112.0, kSagitta);
    EXPECT_NEAR(radiusOfTouch(work[back]), 128.0 + 0.45 * 112.0, kSagitta);
  }
}

TEST(GrindingPath, stepsAreSmall) {
  for (const int passes : {1, 2, 6}) {
    GrindingPathOptions options;
    options.passes = passes;
    const std::vector<Pose> path = pathOf(options);
    for (std::size_t k = 1; k < path.size(); ++k) {
      const Mat3 turn = path[k - 1].rotation.transpose() * path[k].rotation;
      EXPECT_LE((path[k].translation - path[k - 1].translation).norm(), 4.0) << k;
      EXPECT_LE(Eigen::AngleAxisd(turn).angle(), radians(3.0)) << k;
    }
  }
}

TEST(GrindingPath, beginsAndEndsAlongTheArm) {
  const GrindingPathOptions options;
  const std::vector<Pose> path = pathOf(options);
  const Pose& first_work = path[options.retract_poses];
  const Pose& last_work = path[path.size() - 1 - options.retract_poses];
  const Vec3 approach = path.front().translation - first_work.translation;
  const Vec3 retraction = path.back().translation - last_work.translation;
  EXPECT_TRUE(approach.isApprox(60.0 * first_work.rotation.col(0), 1e-12));
  EXPECT_TRUE(retraction.isApprox(60.0 * last_work.rotation.col(0), 1e-12));
  EXPECT_EQ(path.front().rotation, first_work.rotation);
  EXPECT_EQ(path.back().rotation, last_work.rotation);
}

TEST(GrindingPath, theDefaultBeltTouchesItsBladeAndFitsTheChannel) {
  const GrindingPathOptions options;
  const ClusteredOctree belt = ClusteredOctree::build(std::make_shared<const TriangleMesh>(makeBelt()));
  const ClusteredOctree own = treeOfBlades([&](int blade) { return blade == options.blade; });
  const ClusteredOctree rest = treeOfBlades([&](int blade) { return blade != options.blade; });
  const std::vector<Pose> path = pathOf(options);
  for (const Pose& pose : workOf(path, options)) {
    EXPECT_TRUE(collide(own, belt, pose));
    EXPECT_FALSE(collide(rest, belt, pose));
  }
  EXPECT_FALSE(collide(own, belt, path.front()));
  EXPECT_FALSE(collide(own, belt, path.back()));
}

TEST(GrindingPath, doesNotDependOnTheMeshsOrientation) {
  std::vector<TriangleMesh::Indices> inwards = blisk().mesh.triangles();
  for (TriangleMesh::Indices& triangle : inwards) std::swap(triangle[1], triangle[2]);
  const TriangleMesh mesh(blisk().mesh.vertices(), std::move(inwards));
  const std::vector<Pose> path = makeGrindingPath(mesh, blades());
  const std::vector<Pose> expected = pathOf();
  ASSERT_EQ(path.size(), expected.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    EXPECT_TRUE(path[k].translation.isApprox(expected[k].translation, 1e-9));
    EXPECT_TRUE(path[k].rotation.isApprox(expected[k].rotation, 1e-9));
  }
}

TEST(GrindingPath, onePoseIsEnough) {
  GrindingPathOptions options;
  options.passes = options.poses_per_pass = options.retract_poses = 1;
  EXPECT_EQ(pathOf(options).size(), 3u);
}

TEST(GrindingPath, saysInOneLineWhatMakesNoPath) {
  const auto expectThrow = [](const BladesFound& found, const std::string& part,
                              const std::function<void(GrindingPathOptions&)>& spoil) {
    GrindingPathOptions options;
    spoil(options);
    try {
      makeGrindingPath(blisk().mesh, found, options);
      ADD_FAILURE() << "no throw: " << part;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(part), Not(HasSubstr("\n"))));
    }
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto asIs = [](GrindingPathOptions&) {};
  BladesFound none;
  none.blade_of_triangle.assign(blisk().mesh.triangleCount(), 0);
  expectThrow(none, "no blades", asIs);
  BladesFound of_another_mesh = blades();
  of_another_mesh.blade_of_triangle.pop_back();
  expectThrow(of_another_mesh, "not those of this mesh", asIs);
  BladesFound empty_blade = blades();
  std::replace(empty_blade.blade_of_triangle.begin(), empty_blade.blade_of_triangle.end(), 1, 0);
  expectThrow(empty_blade, "no point on its forward side", asIs);

  expectThrow(blades(), "no blade 0", [](auto& o) { o.blade = 0; });
  expectThrow(blades(), "no blade 25: the blades are numbered 1 to 24", [](auto& o) { o.blade = 25; });
  expectThrow(blades(), "number of passes", [](auto& o) { o.passes = 0; });
  expectThrow(blades(), "poses per pass", [](auto& o) { o.poses_per_pass = -1; });
  expectThrow(blades(), "retraction poses", [](auto& o) { o.retract_poses = 0; });
  expectThrow(blades(), "lean", [](auto& o) { o.lean_degrees = kNan; });
  expectThrow(blades(), "lean", [](auto& o) { o.lean_degrees = 90.0; });
  expectThrow(blades(), "edges", [](auto& o) { o.clear_of_edges = 0.5; });
  expectThrow(blades(), "span", [](auto& o) { o.span_from = 1.01; });
  expectThrow(blades(), "span", [](auto& o) { o.span_to = kNan; });
  expectThrow(blades(), "wheel radius", [](auto& o) { o.wheel_radius = 0.0; });
  expectThrow(blades(), "depth", [](auto& o) { o.depth = 9.5; });
  expectThrow(blades(), "retraction", [](auto& o) { o.retract = -1.0; });
}

}  // namespace
}  // namespace octoblisk::demos
