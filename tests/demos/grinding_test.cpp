// The grinding cell and its verdicts, and the default assets.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "demos/block.h"
#include "grinding/verdict.h"
#include "models/belt_grinder.h"
#include "models/blisk.h"
#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

void expectSame(const TriangleMesh& found, const TriangleMesh& expected) {
  ASSERT_EQ(found.triangleCount(), expected.triangleCount());
  for (std::size_t t = 0; t < found.triangleCount(); ++t) {
    for (std::size_t v = 0; v < 3; ++v) {
      ASSERT_LT((found.triangle(t)[v] - expected.triangle(t)[v]).norm(), 1e-4)
          << "triangle " << t;  // files hold floats
    }
  }
}

TEST(EmbeddedAssets, areWhatTheGeneratorsMake) {
  expectSame(embeddedBlisk(), makeDefaultBlisk().mesh);
  const std::vector<EmbeddedPart> parts = embeddedBeltGrinder();
  ASSERT_EQ(parts.size(), 4u);
  expectSame(parts[0].mesh, makeBelt());
  expectSame(parts[1].mesh, makeContactWheel());
  expectSame(parts[2].mesh, makeDriveWheel());
  expectSame(parts[3].mesh, makeArm());
}

TEST(GrindingCell, contacts_vs_bruteforce) {
  const auto blisk = testing::fan(9, 10), ring = testing::torus(0.5, 0.15, 20, 12),
             box = testing::boxMesh({0.3, 0.2, 0.1});
  constexpr double kReach = 0.05;
  GrindingCell cell(treeOf(*blisk), {{"ring", treeOf(*ring)}, {"box", treeOf(*box)}}, {kReach, kReach});
  std::mt19937_64 random(51);
  int hits = 0;
  constexpr int kPoses = 100;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 1.4);
    const std::vector<Touch> found = cell.touchesAt(pose);
    for (std::size_t part = 0; part < 2; ++part) {
      const auto expected = testing::bruteForceContacts(*blisk, part == 0 ? *ring : *box, pose, kReach);
      double least = 1.0;
      for (const Contact& contact : expected) least = std::min(least, contact.distance);
      ASSERT_EQ(std::ranges::count(found, part, &Touch::part), std::ssize(expected)) << "pose " << i;
      for (const Touch& contact : found) {
        if (contact.part != part) continue;
        const auto same = std::ranges::find_if(expected, [&](const Contact& c) {
          return c.triangle_a == contact.contact.triangle_a && c.triangle_b == contact.contact.triangle_b;
        });
        ASSERT_NE(same, expected.end());
        ASSERT_TRUE(contact.contact.point_on_a.isApprox(same->point_on_a, 1e-9));
        ASSERT_TRUE(contact.contact.normal.isApprox(same->normal, 1e-9));
        ASSERT_NEAR(contact.contact.distance, same->distance, 1e-12);
      }
      hits += least <= 0.0;
    }
  }
  EXPECT_GT(hits, 2 * kPoses * 3 / 10);
  EXPECT_LT(hits, 2 * kPoses * 7 / 10);
}

/// The depths of triangle pairs: the deepest contact of each part that touches.
std::vector<PartDepth> depthsOfPairs(std::span<const Touch> touches) {
  std::map<std::size_t, PartDepth> deepest;
  for (const Touch& touch : touches) {
    const Contact& contact = touch.contact;
    if (contact.distance > 0.0) continue;
    const PartDepth here{touch.part, -contact.distance, contact.triangle_a, contact.point_on_a, false};
    const auto [known, is_new] = deepest.try_emplace(touch.part, here);
    if (!is_new && here.depth > known->second.depth) known->second = here;
  }
  std::vector<PartDepth> found;
  for (const auto& [part, depth] : deepest) found.push_back(depth);
  return found;
}

/// Judges by the depths of triangle pairs.
PoseReport judgedReport(const Pose& pose, std::vector<Touch> touches, std::span<const int> blade_of_triangle,
                        const VerdictRules& rules) {
  PoseReport report;
  report.tool_in_blisk = pose;
  report.touches = std::move(touches);
  for (Touch& touch : report.touches) touch.blade = blade_of_triangle[touch.contact.triangle_a];
  report.depths = depthsOfPairs(report.touches);
  for (PartDepth& depth : report.depths) depth.blade = blade_of_triangle[depth.triangle_of_blisk];
  setVerdicts(report, rules);
  return report;
}

/// Four posts of blade 1 around a post of blade 2, which is lower; their tops face up.
struct Posts {
  static constexpr double kStep = 0.01;  ///< by which blade 2 is lower

  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<int> blade_of_triangle;

  Posts() {
    for (const double x : {-2.0, 2.0}) {
      for (const double y : {-2.0, 2.0}) add({x, y, -1.0}, 1);
    }
    add({1.0, -0.5, -1.0 - kStep}, 2);  // off the shared edge of the two triangles
  }

  void add(const Vec3& center, int blade) {
    const auto box = testing::boxMesh({0.3, 0.3, 1.0});
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& corner : box->vertices()) vertices.push_back(corner + center);
    for (const auto& [a, b, c] : box->triangles()) {
      triangles.push_back({first + a, first + b, first + c});
      blade_of_triangle.push_back(blade);
    }
  }
};

// Bullet does not move the boxes of bodies that are larger than a million units.
TEST(GrindingCell, findsThePairsOfAHugePart) {
  GrindingCell cell(treeOf(moved(block({5, 5, 5}, 1), Vec3(1000, 0, 0))),
                    {{"rod", treeOf(block({1, 1, 600000}, 1))}}, {0.5});
  EXPECT_TRUE(cell.touchesAt(at(0, 0, 0)).empty());
  EXPECT_FALSE(cell.touchesAt(at(1000, 0, 0)).empty());
  EXPECT_FALSE(cell.touchesAt(at(1005.5, 0, 0)).empty());
  EXPECT_TRUE(cell.touchesAt(at(2000, 0, 0)).empty());
}

TEST(ReduceContacts, aShallowInterferenceIsNotHiddenByTheIntendedContactRoundIt) {
  const Posts posts;
  GrindingCell cell(treeOf({posts.vertices, posts.triangles}),
                    {{"belt", treeOf(*testing::boxMesh({5, 5, 1}))}}, {0.5});
  const VerdictRules rules{.ground_blade = 1, .max_depth = 0.1};
  const auto judged = [&](double depth, bool per_blade) {
    const Pose pose{Mat3::Identity(), Vec3(0.0, 0.0, 1.0 - depth)};
    const std::vector<Touch> all = cell.touchesAt(pose);
    // As if all triangles belonged to one blade: a few contacts of each patch, on any of the blades.
    const std::vector<int> one_blade(posts.triangles.size(), 1);
    return judgedReport(pose, reduceContacts(all, per_blade ? posts.blade_of_triangle : one_blade),
                        posts.blade_of_triangle, rules);
  };
  EXPECT_LT(judged(0.05, false).verdict, Verdict::interference) << "the scene hides nothing";
  const PoseReport report = judged(0.05, true);
  EXPECT_EQ(report.verdict, Verdict::interference);
  const Touch worst = *worstTouch(report);
  EXPECT_EQ(worst.blade, 2);
  EXPECT_EQ(worst.deepest_blade, 1);
  EXPECT_NEAR(worst.depth, 0.05, 1e-12) << "the belt's depth, wherever it is deepest";
  EXPECT_EQ(judged(Posts::kStep / 2, true).verdict, Verdict::near_miss) << "apart from blade 2";
}

TEST(ReduceContacts, verdicts_vs_all_contacts_of_bruteforce) {
  const auto blisk = testing::fan(9, 10), belt = testing::torus(0.5, 0.15, 20, 12);
  constexpr double kReach = 0.05;
  GrindingCell cell(treeOf(*blisk), {{"belt", treeOf(*belt)}}, {kReach});
  const VerdictRules rules{.ground_blade = 1, .max_depth = 0.15};
  std::mt19937_64 random(52);
  int interference = 0, fewer = 0;
  constexpr int kPoses = 150;
  for (int i = 0; i < kPoses; ++i) {
    std::vector<int> blade_of_triangle(blisk->triangleCount());  // most of blade 1, some of others or the hub
    for (int& blade : blade_of_triangle) blade = random() % 20 == 0 ? int(random() % 3) : 1;
    const Pose pose = testing::randomPose(random, 1.4);

    const auto of_pairs = testing::bruteForceContacts(*blisk, *belt, pose, kReach);
    double depth = 0.0;  // of the belt
    for (const Contact& contact : of_pairs) depth = std::max(depth, -contact.distance);
    std::pair<Verdict, double> expected{Verdict::clear, -1.0};  // verdict and depth of the worst contact
    for (const Contact& contact : of_pairs) {
      const PartDepth of_belt{.depth = depth};
      const Verdict verdict = verdictOf({0, blade_of_triangle[contact.triangle_a], contact}, &of_belt, rules);
      expected = std::max(expected, {verdict, contact.distance <= 0.0 ? depth : -contact.distance});
    }
    const std::vector<Touch> all = cell.touchesAt(pose);
    const PoseReport report =
        judgedReport(pose, reduceContacts(all, blade_of_triangle), blade_of_triangle, rules);
    ASSERT_EQ(report.verdict, expected.first) << "pose " << i;
    const Touch* const worst = worstTouch(report);
    ASSERT_EQ(worst != nullptr, !all.empty());
    if (worst) {
      ASSERT_NEAR(worst->depth, expected.second, 1e-9) << "pose " << i;
    }
    interference += report.verdict == Verdict::interference;
    fewer += report.touches.size() < all.size();
  }
  EXPECT_GT(interference, kPoses * 3 / 10);
  EXPECT_LT(interference, kPoses * 7 / 10);
  EXPECT_GT(fewer, kPoses * 3 / 10) << "nothing to reduce";
}

Touch touchOf(std::size_t part, int blade, double distance) {
  return {.part = part, .blade = blade, .contact = {.distance = distance}};
}

TEST(Verdict, onlyTheBeltMayTouchOnlyTheGroundBladeOnlySoDeep) {
  const VerdictRules rules{.grinding_part = 0, .ground_blade = 3, .max_depth = 0.1};
  const auto touch = [&](std::size_t part, int blade, double depth, bool is_known = true) {
    const PartDepth of_part{.part = part, .depth = depth, .is_known = is_known};
    return verdictOf(touchOf(part, blade, -1e-3), &of_part, rules);  // the triangle pair is less deep
  };
  const auto apart = [&](std::size_t part, int blade) {
    return verdictOf(touchOf(part, blade, 0.2), nullptr, rules);
  };
  EXPECT_EQ(touch(0, 3, 0.05, false), Verdict::unknown);
  EXPECT_EQ(touch(0, 3, 0.15, false), Verdict::interference) << "too deep";
  EXPECT_EQ(touch(0, 4, 0.05, false), Verdict::interference) << "any touch is interference";
  EXPECT_EQ(apart(0, 3), Verdict::clear);
  EXPECT_EQ(touch(0, 3, 0.05), Verdict::intended_contact);
  EXPECT_EQ(touch(0, 3, 0.1), Verdict::intended_contact);
  EXPECT_EQ(touch(0, 3, 0.15), Verdict::interference);
  EXPECT_EQ(touch(0, 4, 0.05), Verdict::interference);
  EXPECT_EQ(apart(0, 4), Verdict::near_miss);
  EXPECT_EQ(touch(0, 0, 0.05), Verdict::interference);  // the hub
  EXPECT_EQ(touch(1, 3, 0.05), Verdict::interference);  // the wheel
  EXPECT_EQ(apart(1, 3), Verdict::near_miss);
  const VerdictRules no_blade{.ground_blade = 0};
  EXPECT_EQ(verdictOf(touchOf(0, 0, -0.05), nullptr, no_blade), Verdict::interference);
}

TEST(Verdict, ofAPoseIsTheWorstOfItsContacts) {
  PoseReport pose, clear;
  pose.touches = {touchOf(0, 3, -0.05), touchOf(1, 3, 0.2), touchOf(0, 4, -0.01)};
  pose.depths = {{.part = 0, .depth = 0.07, .blade = 3}};
  setVerdicts(pose, {.ground_blade = 3});
  setVerdicts(clear, {.ground_blade = 3});
  EXPECT_EQ(pose.verdict, Verdict::interference);
  const Touch worst = *worstTouch(pose);
  EXPECT_EQ(worst.blade, 4) << "not the deepest contact, but the forbidden one";
  EXPECT_EQ(worst.depth, 0.07);
  EXPECT_EQ(worstTouch(clear), nullptr);
  EXPECT_EQ(clear.verdict, Verdict::clear);
}

TEST(Verdict, ofAPartWhollyInsideIsInterference) {
  PoseReport pose;
  pose.touches = {touchOf(0, 3, 0.2)};  // away from the surface, inside
  pose.depths = {{.part = 0, .depth = 1.5, .is_inside = true, .blade = 3}};
  setVerdicts(pose, {.ground_blade = 3});
  EXPECT_EQ(pose.verdict, Verdict::interference);
  const Touch worst = *worstTouch(pose);
  EXPECT_TRUE(worst.is_inside);
  EXPECT_EQ(worst.depth, 1.5);
}

}  // namespace
}  // namespace octoblisk::demos
