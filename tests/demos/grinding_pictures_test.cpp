// The content of a grinding run's pictures.
#include "report/grinding_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "demos/block.h"
#include "models/shared_tree.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

/// An arm beside a block, which is blade 2 as a whole; the arm touches it, or is 40 mm away.
GrindingRun runWith(bool touches) {
  GrindingRun run;
  run.job.blisk = treeOf(block({50, 50, 20}, 16));
  run.job.parts = {{"arm", treeOf(block({5, 5, 5}, 2))}};
  run.job.blades.blade_of_triangle.assign(run.job.blisk->mesh().triangleCount(), 2);
  run.job.rules.ground_blade = 2;
  run.job.rules.grinding_part = 0;
  PoseReport pose;
  pose.tool_in_blisk.translation = Vec3(touches ? 54.95 : 95.0, 0, 0);
  if (touches) {
    pose.touches = {{.blade = 2, .contact = {.point_on_a = Vec3(50, 0, 0), .distance = -0.05}}};
    pose.depths = {{.part = 0, .depth = 0.05, .blade = 2}};
  }
  setVerdicts(pose, run.job.rules);
  run.poses = {pose};
  return run;
}

bool hasEntry(const Picture& picture, const std::string& text) {
  return std::ranges::any_of(picture.annotation.legend, [&](const LegendEntry& entry) {
    return entry.text.find(text) != std::string::npos;
  });
}

std::size_t linesOf(const Picture& picture) {
  return static_cast<std::size_t>(
      std::ranges::count(picture.scene.marks(), Scene::MarkKind::lines, &Scene::Marks::kind));
}

TEST(GrindingPictures, theGroundBladeIsMarked) {
  GrindingRun run = runWith(true);
  const Picture marked = overviewOf(run);
  EXPECT_TRUE(hasEntry(marked, "ground blade 2"));
  const Color& of_blade = marked.scene.solids().front().colors.front();
  EXPECT_NE(of_blade.r, palette::kSteel.r);
  run.job.rules.ground_blade = 0;
  const Picture none = overviewOf(run);
  EXPECT_FALSE(hasEntry(none, "ground blade"));
  EXPECT_EQ(none.scene.solids().front().colors.front().r, palette::kSteel.r);
}

TEST(GrindingPictures, everyLegendEntryHasAColourOfItsOwn) {
  for (const Picture& picture : {overviewOf(runWith(true)), closeupOf(runWith(true))}) {
    const auto& legend = picture.annotation.legend;
    for (std::size_t i = 0; i < legend.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Color &a = legend[i].color, &b = legend[j].color;
        EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 0.1f)
            << legend[i].text << ", " << legend[j].text;
      }
    }
    EXPECT_TRUE(hasEntry(picture, "intended contact"));
  }
}

TEST(GrindingPictures, boxesAreInTheLegendWhereThereAreAnyAndShineThroughSurfaces) {
  const Picture touching = closeupOf(runWith(true));
  EXPECT_TRUE(hasEntry(touching, "boxes of the tree"));
  ASSERT_EQ(linesOf(touching), 1u);
  EXPECT_GT(std::ranges::find(touching.scene.marks(), Scene::MarkKind::lines, &Scene::Marks::kind)
                ->style.hidden_opacity,
            0.0f);
  const Picture apart = closeupOf(runWith(false));
  EXPECT_EQ(linesOf(apart), 0u);
  EXPECT_FALSE(hasEntry(apart, "boxes"));
}

TEST(GrindingPictures, withoutContactTheCloseUpShowsBothWhereTheyAreNearest) {
  const Picture apart = closeupOf(runWith(false));
  EXPECT_THAT(apart.annotation.subtitle, HasSubstr("the arm is 40.00 mm away"));
  EXPECT_NEAR(apart.camera.target.x(), 70.0, 1e-6) << "between the two";
  EXPECT_GT(std::min(apart.camera.view_width, apart.camera.view_height), 40.0);
}

TEST(GrindingPictures, posesAreCountedFromZero) {
  EXPECT_EQ(overviewOf(runWith(true)).annotation.title, "Pose 0 (of 0-0): intended contact");
}

}  // namespace
}  // namespace octoblisk::demos
