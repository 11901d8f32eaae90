#include "geometry/separating_axis.h"

#include <gtest/gtest.h>

#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::randomPoint;
using testing::randomPose;
using testing::uniform;

Obb randomBox(std::mt19937_64& random, double spread) {
  const Pose pose = randomPose(random, spread);
  const Vec3 half = randomPoint(random, 1.0).cwiseAbs() + Vec3::Constant(0.05);
  return {pose.translation, pose.rotation, half};
}

/// Whether a segment meets a box: the slab method, in the box's frame.
bool segmentMeetsBox(const Obb& box, const Vec3& from, const Vec3& to) {
  const Vec3 start = box.axes.transpose() * (from - box.center), step = box.axes.transpose() * (to - from);
  double enter = 0.0, leave = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double t0 = (-box.half_extents[k] - start[k]) / step[k],
                 t1 = (box.half_extents[k] - start[k]) / step[k];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return enter <= leave;
}

/// Two boxes overlap if an edge of one meets the other, or if one contains the other's centre.
bool overlapByEdges(const Obb& a, const Obb& b) {
  const auto anyEdgeMeets = [](const Obb& box, const Obb& other) {
    for (int corner = 0; corner < 8; ++corner) {
      for (int k = 0; k < 3; ++k) {
        if (corner & 1 << k) continue;
        const auto at = [&](int c) {
          const Vec3 side(c & 1 ? 1.0 : -1.0, c & 2 ? 1.0 : -1.0, c & 4 ? 1.0 : -1.0);
          return Vec3(box.center + box.axes * side.cwiseProduct(box.half_extents));
        };
        if (segmentMeetsBox(other, at(corner), at(corner | 1 << k))) return true;
      }
    }
    return false;
  };
  return a.contains(b.center) || b.contains(a.center) || anyEdgeMeets(a, b) || anyEdgeMeets(b, a);
}

TEST(SeparatingAxis, exact15EqualsEdgesAgainstBoxes) {
  std::mt19937_64 random(6);
  int hits = 0;
  constexpr int kCases = 50'000;
  for (int i = 0; i < kCases; ++i) {
    const Obb a = randomBox(random, 1.0), b = randomBox(random, 1.0);
    const bool expected = overlapByEdges(a, b);
    hits += expected;
    ASSERT_EQ(overlaps(a, b), expected) << "case " << i;
    ASSERT_EQ(overlaps(b, a), expected) << "case " << i;
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

TEST(SeparatingAxis, someBoxesArePartedByEdgeAxesAlone) {
  std::mt19937_64 random(7);
  int edge_axes_needed = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Obb a = randomBox(random, 0.8), b = randomBox(random, 0.8);
    bool faces_part = false;
    for (int k = 0; k < 3; ++k) {
      const Obb a_turned{
          a.center,
          (Mat3() << a.axes.col(k), a.axes.col((k + 1) % 3), a.axes.col((k + 2) % 3)).finished(),
          {a.half_extents[k], a.half_extents[(k + 1) % 3], a.half_extents[(k + 2) % 3]}};
      const Obb b_turned{
          b.center,
          (Mat3() << b.axes.col(k), b.axes.col((k + 1) % 3), b.axes.col((k + 2) % 3)).finished(),
          {b.half_extents[k], b.half_extents[(k + 1) % 3], b.half_extents[(k + 2) % 3]}};
      faces_part |=
          !overlaps(a_turned, b, SeparatingAxes::first_x) || !overlaps(b_turned, a, SeparatingAxes::first_x);
    }
    edge_axes_needed += !faces_part && !overlaps(a, b);
  }
  EXPECT_GT(edge_axes_needed, 100);
}

TEST(SeparatingAxis, paper1NeverMissesButOftenClaims) {
  std::mt19937_64 random(8);
  int false_claims = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Obb a = randomBox(random, 1.5), b = randomBox(random, 1.5);
    const bool exact = overlaps(a, b), paper = overlaps(a, b, SeparatingAxes::first_x);
    ASSERT_TRUE(paper || !exact);
    false_claims += paper && !exact;
  }
  EXPECT_GT(false_claims, 2'000);
}

TEST(SeparatingAxis, parallelAndTouchingBoxes) {
  const Obb a{Vec3::Zero(), Mat3::Identity(), Vec3(1, 1, 1)};
  EXPECT_TRUE(overlaps(a, Obb{{2, 0, 0}, Mat3::Identity(), Vec3(1, 1, 1)}));
  EXPECT_FALSE(overlaps(a, Obb{{2.000001, 0, 0}, Mat3::Identity(), Vec3(1, 1, 1)}));
  EXPECT_TRUE(overlaps(a, Obb{{2, 2, 2}, Mat3::Identity(), Vec3(1, 1, 1)}));
  EXPECT_TRUE(overlaps(a, Obb{{0.5, 0, 0}, Mat3::Identity(), Vec3(0, 0, 0)}));
}

}  // namespace
}  // namespace octoblisk
