// The grinding cell and its verdicts, and the default assets that they run on.
#include <gtest/gtest.h>

#include <algorithm>

#include "cell/verdict.h"
#include "models/belt_grinder.h"
#include "models/blisk.h"
#include "models/embedded_assets.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

std::shared_ptr<const ClusteredOctree> treeOf(const TriangleMesh& mesh) {
  return std::make_shared<const ClusteredOctree>(
      ClusteredOctree::build(std::make_shared<const TriangleMesh>(mesh)));
}

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
  GrindingCell cell(treeOf(*blisk), {{"ring", treeOf(*ring)}, {"box", treeOf(*box)}}, kReach);
  std::mt19937_64 random(51);
  int hits = 0;
  constexpr int kPoses = 100;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 1.4);
    const std::vector<PartContact> found = cell.contactsAt(pose);
    for (std::size_t part = 0; part < 2; ++part) {
      const auto expected = testing::bruteForceContacts(*blisk, part == 0 ? *ring : *box, pose, kReach);
      double least = 1.0, reported = 1.0;
      for (const Contact& contact : expected) least = std::min(least, contact.distance);
      for (const PartContact& contact : found) {
        if (contact.part != part) continue;
        reported = std::min(reported, contact.contact.distance);
        const auto same = std::ranges::find_if(expected, [&](const Contact& c) {
          return c.triangle_a == contact.contact.triangle_a && c.triangle_b == contact.contact.triangle_b;
        });
        ASSERT_NE(same, expected.end());
        ASSERT_TRUE(contact.contact.point_on_a.isApprox(same->point_on_a, 1e-9));
        ASSERT_TRUE(contact.contact.normal.isApprox(same->normal, 1e-9));
      }
      ASSERT_NEAR(reported, least, 1e-12) << "pose " << i;
      hits += least <= 0.0;
    }
  }
  EXPECT_GT(hits, 2 * kPoses * 3 / 10);
  EXPECT_LT(hits, 2 * kPoses * 7 / 10);
}

PartContact contactOf(std::size_t part, double distance) {
  PartContact contact;
  contact.part = part;
  contact.contact.distance = distance;
  return contact;
}

TEST(Verdict, onlyTheBeltMayTouchOnlyTheGroundBladeOnlySoDeep) {
  const VerdictRules rules{.grinding_part = 0, .ground_blade = 3, .max_depth = 0.1};
  EXPECT_EQ(verdictOf(contactOf(0, 0.2), 3, rules), Verdict::clear);
  EXPECT_EQ(verdictOf(contactOf(0, -0.05), 3, rules), Verdict::intended_contact);
  EXPECT_EQ(verdictOf(contactOf(0, -0.15), 3, rules), Verdict::interference);
  EXPECT_EQ(verdictOf(contactOf(0, -0.05), 4, rules), Verdict::interference);
  EXPECT_EQ(verdictOf(contactOf(0, 0.2), 4, rules), Verdict::near_miss);
  EXPECT_EQ(verdictOf(contactOf(0, -0.05), 0, rules), Verdict::interference);  // the hub
  EXPECT_EQ(verdictOf(contactOf(1, -0.05), 3, rules), Verdict::interference);  // the wheel
  EXPECT_EQ(verdictOf(contactOf(1, 0.2), 3, rules), Verdict::near_miss);
  const VerdictRules no_blade{.ground_blade = 0};
  EXPECT_EQ(verdictOf(contactOf(0, -0.05), 0, no_blade), Verdict::interference);
}

TEST(Verdict, ofAPoseIsTheWorstOfItsContacts) {
  std::vector<PoseReport> poses(2);
  poses[0].contacts = {contactOf(0, -0.05), contactOf(1, 0.2), contactOf(0, -0.01)};
  poses[0].blades = {3, 3, 4};
  judge(poses, {.ground_blade = 3});
  EXPECT_EQ(poses[0].verdict, Verdict::interference);
  EXPECT_EQ(poses[1].verdict, Verdict::clear);
  EXPECT_EQ(mostTouchedBlade(poses, 0), 3);
  EXPECT_EQ(mostTouchedBlade(poses, 1), 0);
}

}  // namespace
}  // namespace octoblisk::demos
