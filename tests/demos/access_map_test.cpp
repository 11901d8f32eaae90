// Free ranges of tilt and lead, compared with closed forms.
#include "access/access_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "access/access_picture.h"
#include "access/access_replay.h"
#include "access/access_summary.h"
#include "demos/block.h"
#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "octoblisk/closest_point.h"

namespace octoblisk::demos {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A bar 2 mm thick from the origin to x = 20, in a slot between planes at y = ± half_gap.
constexpr double kLength = 20.0, kHalfThickness = 1.0, kHalfGap = 7.3;

struct Slot {
  TriangleMesh walls = joined(moved(block({60, 5, 20}, 3), {0, kHalfGap + 5, 0}),
                              moved(block({60, 5, 20}, 3), {0, -kHalfGap - 5, 0}));
  TriangleMesh bar = moved(block({0.5 * kLength, kHalfThickness, 3}, 4), {0.5 * kLength, 0, 0});
};

ContactSite siteAtOrigin() {
  ContactSite site;
  site.normal = Vec3::UnitY();
  return site;
}

TEST(AccessMap, ofABarInASlotIsTheClosedForm) {
  const Slot slot;
  for (const double margin : {0.0, 1.5}) {
    // A far corner is L sin t + h cos t away from the middle plane.
    const auto is_free = [&](int degrees) {
      const double tilt = degrees * kDegree;
      const double reach = kLength * std::abs(std::sin(tilt)) + kHalfThickness * std::abs(std::cos(tilt));
      return reach < kHalfGap - margin;
    };
    int last = 0;
    while (is_free(last + 1)) ++last;
    ASSERT_GT(last, 5);
    Judge judge(treeOf(slot.walls), {{"bar", treeOf(slot.bar)}},
                std::vector<int>(slot.walls.triangleCount(), 0), {.ground_blade = 0, .near_miss = margin});
    const ContactSite site = siteAtOrigin();
    const auto found = accessOf(judge, {&site, 1}, {});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].free, 2 * (2 * static_cast<std::size_t>(last) + 1));
    ASSERT_EQ(found[0].ranges.size(), 2u);
    EXPECT_EQ(found[0].ranges[0].tilt_from, -last);
    EXPECT_EQ(found[0].ranges[0].tilt_to, last);
    EXPECT_EQ(found[0].ranges[1].tilt_from, 180 - last) << "joined across half a turn";
    EXPECT_EQ(found[0].ranges[1].tilt_to, 180 + last);
    ASSERT_EQ(found[0].obstacles.size(), 1u);
    EXPECT_EQ(found[0].obstacles[0].times, 360 - found[0].free);
  }
}

TEST(AccessMap, leadTurnsTheBarOutOfTheSlotsPlaneOrNot) {
  // About the normal y the bar stays between the planes: every lead is free at tilt 0.
  const Slot slot;
  Judge judge(treeOf(slot.walls), {{"bar", treeOf(slot.bar)}},
              std::vector<int>(slot.walls.triangleCount(), 0), {.ground_blade = 0, .near_miss = 0.0});
  ContactSite site = siteAtOrigin();
  AccessOptions options{.tilt_from = -90.0, .tilt_step = 30.0, .tilts = 7, .leads = {-40.0, 0.0, 40.0}};
  EXPECT_FALSE(options.isFullTurn());
  auto found = accessOf(judge, {&site, 1}, options);
  EXPECT_EQ(found[0].free, 3u) << "tilt 0 alone";
  EXPECT_EQ(found[0].lead_from, -40.0);
  EXPECT_EQ(found[0].lead_to, 40.0);
  // About z it does not stay between them.
  site.normal = Vec3::UnitZ();
  found = accessOf(judge, {&site, 1}, options);
  ASSERT_TRUE(found[0].widest);
  EXPECT_EQ(found[0].ranges[*found[0].widest].width(), 0.0);
  std::size_t free_at_no_lead = 0;
  for (const FreeRange& range : found[0].ranges) free_at_no_lead += range.lead == 1;
  EXPECT_EQ(free_at_no_lead, 1u);
}

TEST(AccessMap, tiltAndLeadKeepAWheelOnItsPoint) {
  ContactSite site;
  site.point = Vec3(100, 20, 3);
  site.normal = Vec3(1, 2, 2).normalized();
  const Vec3 arm = site.normal.unitOrthogonal();
  site.base.rotation << arm, site.normal, arm.cross(site.normal);
  site.base.translation = site.point + 9.5 * site.normal;
  for (const double tilt : {-70.0, 0.0, 33.0}) {
    for (const double lead : {-20.0, 0.0, 12.0}) {
      const Pose pose = tiltedPose(site, tilt, lead);
      EXPECT_NEAR((pose.translation - site.base.translation).norm(), 0.0, 1e-12);
      EXPECT_NEAR(pose.rotation.col(2).dot(site.normal), 0.0, 1e-12) << "the axis stays in the tangent plane";
      EXPECT_NEAR(pose.rotation.col(0).dot(site.normal), std::sin(tilt * kDegree), 1e-12);
      EXPECT_NEAR(pose.rotation.col(2).dot(site.base.rotation.col(2)), std::cos(lead * kDegree), 1e-12);
      if (tilt == 0.0 && lead > 0.0) {
        EXPECT_GT(pose.rotation.col(0).dot(site.base.rotation.col(2)), 0.0);
      }
    }
  }
}

TEST(AccessMap, gridPointsLieOnTheSideAndFaceOutwards) {
  const TriangleMesh blisk = embeddedBlisk();
  const BladesFound blades = findBlades(blisk);
  const auto tree = treeOf(blisk);
  for (const bool forward : {true, false}) {
    SiteGridOptions options;
    options.blade = 3;
    options.forward_side = forward;
    options.rows = 4;
    options.columns = 5;
    const auto sites = sitesOnBlade(blisk, blades, options);
    ASSERT_EQ(sites.size(), 20u);
    double last_arc = -1.0;
    for (const ContactSite& site : sites) {
      const auto closest = closestPoint(*tree, site.point);
      EXPECT_LT(closest->distance, 1e-9);
      EXPECT_EQ(blades.blade_of_triangle[closest->triangle], 3);
      const Vec3 along(-site.point.y(), site.point.x(), 0.0);
      EXPECT_EQ(site.normal.dot(along) > 0.0, forward);
      const auto off = closestPoint(*tree, site.point + 0.5 * site.normal);
      EXPECT_NEAR(off->distance, 0.5, 0.01) << "half a millimetre out";
      EXPECT_NEAR(std::hypot(site.point.x(), site.point.y()), blades.root_radius + site.height, 0.1);
      if (site.arc > last_arc) {
        EXPECT_GT(site.arc, 0.0);
      }
      last_arc = site.arc;
    }
  }
  SiteGridOptions bad;
  bad.blade = 25;
  EXPECT_THROW(sitesOnBlade(blisk, blades, bad), std::invalid_argument);
  bad = {};
  bad.span_to = 1.5;
  EXPECT_THROW(sitesOnBlade(blisk, blades, bad), std::invalid_argument);
}

TEST(AccessMap, oneFreeTiltIsCalledSo) {
  const Slot slot;
  const auto walls = treeOf(slot.walls);
  AccessMap map;
  map.parts = {{"bar", treeOf(slot.bar)}};
  map.sites = {siteAtOrigin()};
  BladesFound blades;
  blades.blade_of_triangle.assign(slot.walls.triangleCount(), 0);
  Judge judge(walls, map.parts, blades.blade_of_triangle, {.ground_blade = 0, .near_miss = 0.0});
  const auto verdictOf = [&](double tilt_from, int tilts) {
    map.question.options.tilt_from = tilt_from;
    map.question.options.tilts = tilts;
    map.access = accessOf(judge, map.sites, map.question.options);
    const Replay replay = accessReplay(map, walls, blades, "a slot");
    const ReplayPose& pose = replay.tracks.front().poses.front();
    return replay.verdicts[pose.verdict].name + ": " + pose.text;
  };
  EXPECT_EQ(verdictOf(0.0, 1), "free at one tilt: tilt 0° alone at lead 0°");
  EXPECT_EQ(verdictOf(0.0, 6), "free over 30° or less: tilt 0° to 5° at lead 0°, shown at their middle");
  EXPECT_EQ(verdictOf(90.0, 1), "nowhere free: most frequent obstacle: bar on hub or shroud");
}

TEST(AccessMap, pictureShowsEachPointInItsColour) {
  std::vector<AccessRow> rows(2);
  for (int k = 0; k < 2; ++k) {
    rows[k].arc = 10.0 * k;
    rows[k].half_width = rows[k].half_height = 5.0;
  }
  rows[1].widest = 100.0;
  const Image image = accessPicture(rows, {}, 800, 600);
  const auto count = [&](const Image::Pixel& pixel) { return std::ranges::count(image.pixels, pixel); };
  const Image::Pixel none = {214, 64, 0, 255}, most = {38, 74, 135, 255};
  EXPECT_GT(count(none), 10'000);
  EXPECT_NEAR(static_cast<double>(count(none)), static_cast<double>(count(most)), 0.02 * count(none));
}

TEST(AccessMap, whatAStudyKeepsInLinesIsReadBack) {
  AccessQuestion question;
  question.of_path = true;
  question.rules = {.grinding_part = 2, .ground_blade = 7, .near_miss = 0.3};
  question.options = {-30.5, 0.1, 12, {-5.0, 0.0, 5.0}};
  const AccessQuestion same = questionOfLine(lineOf(question));
  EXPECT_EQ(lineOf(same), lineOf(question));
  EXPECT_TRUE(same.of_path);
  EXPECT_EQ(same.rules.ground_blade, 7);
  EXPECT_EQ(same.rules.near_miss, 0.3);
  EXPECT_EQ(same.options.tilt_step, 0.1);
  EXPECT_EQ(same.options.leads, question.options.leads);
  EXPECT_THROW(questionOfLine("clearance tolerance 1"), std::invalid_argument);
  for (const std::string behind : {"x", " ", " 0 x", " 0\x1b"}) {
    EXPECT_THROW(questionOfLine(lineOf(question) + behind), std::invalid_argument) << behind;
  }

  AccessSummary summary{9, 100, 3, {{"arm on hub or shroud", 2}, {"belt too deep in blade 1", 1}}};
  AccessSummary read = accessSummaryOfTally(tallyOf(summary));
  EXPECT_EQ(tallyOf(read), tallyOf(summary));
  read.add(summary);
  EXPECT_EQ(read.points, 18u);
  EXPECT_EQ(read.obstacles.at("arm on hub or shroud"), 4u);
  for (const std::string wrong :
       {"none", "1 0", "1 0 0 rubbish", "1 0 0 ", "1 0 0\t", "1 0 -1", "1 0 1\tbelt", "1 0 1\t1",
        "1 0 1\t1 belt\x1b[2J", "1 0 1\t1 b\xc3\xa9lt"}) {
    EXPECT_THROW(accessSummaryOfTally(wrong), std::invalid_argument) << wrong;
  }
  EXPECT_EQ(accessSummaryOfTally("1 0 1\t1  belt on blade 2").obstacles.count(" belt on blade 2"), 1u)
      << "a part's name may begin with a space";
}

}  // namespace
}  // namespace octoblisk::demos
