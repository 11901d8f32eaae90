// The depth of large triangles in the belt, whose triangles are a hundred times smaller.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "models/belt_grinder.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk/depth.h"

namespace octoblisk::demos {
namespace {

TEST(BeltDepth, ofALargeTriangleIsFoundInBoundedTime) {
  // When the triangle was divided wherever the nearest triangle of the belt changes, its parts became ever
  // thinner needles.
  const Triangle triangle = {Vec3(44.210235595703125, 216.90574645996094, -17.76934814453125),
                             Vec3(47.041255950927734, 235.3446807861328, -15.842578887939453),
                             Vec3(57.97440719604492, 232.89260864257812, -23.37813377380371)};
  const Pose belt_in_blisk = {
      Eigen::Quaterniond(0.70105484405210539, -0.37921261554154517, -0.28733384587666799, 0.53118655749081389)
          .normalized()
          .toRotationMatrix(),
      Vec3(60.240848303669871, 233.34177328885778, -35.95300755613885)};
  const Pose blisk_in_belt = belt_in_blisk.inverse();

  const auto belt = std::make_shared<const TriangleMesh>(makeBelt());
  const auto one = std::make_shared<const TriangleMesh>(std::vector<Vec3>(triangle.begin(), triangle.end()),
                                                        std::vector<TriangleMesh::Indices>{{0, 1, 2}});
  const ClusteredOctree belt_tree = ClusteredOctree::build(belt), tree_of_one = ClusteredOctree::build(one);
  const Surface belt_surface(belt_tree), surface_of_one(tree_of_one);
  DepthQuery query;
  const GougeDepth found = query.deepest(belt_surface, surface_of_one, blisk_in_belt, 0.01);
  ASSERT_EQ(found.gouging, Gouging::found);
  EXPECT_LE(found.upper_bound, found.depth + 0.01);

  double deepest = 0.0;  // over the points of a grid
  constexpr int kSteps = 300;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const double u = double(i) / kSteps, v = double(j) / kSteps;
      const Vec3 point =
          blisk_in_belt * (triangle[0] + u * (triangle[1] - triangle[0]) + v * (triangle[2] - triangle[0]));
      const auto nearest = closestPoint(belt_tree, point, 0.2);
      if (nearest && nearest->distance > deepest && locate(belt_surface, point) == PointLocation::inside)
        deepest = nearest->distance;
    }
  }
  EXPECT_GT(deepest, 0.02);
  EXPECT_LE(deepest, found.upper_bound);
}

}  // namespace
}  // namespace octoblisk::demos
