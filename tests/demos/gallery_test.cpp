// The gallery: the numbers of its scenes, and the arrangement of their pictures on a sheet.
#include "gallery/gallery.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "gallery/gallery_scene.h"
#include "render/contact_sheet.h"

namespace octoblisk::gallery {
namespace {

using ::testing::HasSubstr;

/// The scene's numbers by name.
double number(const GalleryScene& scene, const std::string& name) {
  for (const Number& each : scene.numbers()) {
    if (each.name == name) return each.value;
  }
  ADD_FAILURE() << "no number " << name;
  return 0.0;
}

void run(GalleryScene& scene, int steps) {
  for (int step = 0; step < steps; ++step) scene.step();
}

TEST(Gallery, theRingFallsOverThePegWithEveryPartition) {
  for (const BuildOptions& tree : {BuildOptions{}, BuildOptions{.partition = PartitionKind::paper},
                                   BuildOptions{.partition = PartitionKind::paper, .clusters = 0}}) {
    const auto scene = makeHelloShape(tree);
    EXPECT_GT(number(*scene, "ring_height_m"), 1.9);
    run(*scene, 480);
    EXPECT_NEAR(number(*scene, "ring_height_m"), 0.16, 0.02);  // its tube's radius, and two margins of 10 mm
    EXPECT_LT(number(*scene, "kinetic_energy_j"), 0.1);
  }
}

TEST(Gallery, theChainHolds) {
  const auto scene = makeChainOfTori(3);
  run(*scene, 120);
  EXPECT_GT(number(*scene, "kinetic_energy_j"), 1e-3);
  EXPECT_LT(number(*scene, "greatest_pitch_m"), 0.82);  // 2 (R - r) = 0.76 where tubes touch
  EXPECT_GT(number(*scene, "least_pitch_m"), 0.5);
}

TEST(Gallery, theTowerStands) {
  const auto scene = makeTower(5);
  const double top = number(*scene, "top_m");
  run(*scene, 20 * 60);
  EXPECT_NEAR(number(*scene, "top_m"), top, 0.02);
  EXPECT_LT(number(*scene, "creep_mm"), 250.0);  // half the radius
}

TEST(Gallery, gearsTurnByTheirTeeth) {
  const auto scene = makeGearTrain();
  run(*scene, 60);
  double first = 0.0, second = 0.0, third = 0.0;
  for (int step = 0; step < 60; ++step) {
    run(*scene, 1);
    first += number(*scene, "gear_12_teeth_rad_s");
    second += number(*scene, "gear_20_teeth_rad_s");
    third += number(*scene, "gear_16_teeth_rad_s");
  }
  EXPECT_NEAR(std::abs(first) / 60.0, 2.0, 0.2);
  EXPECT_NEAR(second / first, -12.0 / 20.0, 0.1);
  EXPECT_NEAR(third / first, 12.0 / 16.0, 0.1);
}

TEST(Gallery, debrisSlowsTheBlisk) {
  const auto scene = makeBliskAndDebris(6);
  const double before = number(*scene, "blisk_rad_s");
  double most_points = 0.0;
  for (int step = 0; step < 96; ++step) {
    run(*scene, 1);
    most_points = std::max(most_points, number(*scene, "contact_points"));
  }
  EXPECT_GT(most_points, 0.0);
  EXPECT_LT(number(*scene, "blisk_rad_s"), before);
  EXPECT_GT(number(*scene, "blisk_rad_s"), 0.9 * before);
}

TEST(Gallery, aPileFalls) {
  const auto scene = makePile(8);
  run(*scene, 45);
  EXPECT_EQ(number(*scene, "bodies_fallen"), 0.0);
  EXPECT_LT(number(*scene, "depth_in_floor_mm"), 150.0);
  EXPECT_EQ(scene->picture().scene.solids().size(), 9u);
}

TEST(Gallery, theClothStaysOnOurChannelAndFallsThroughGimpacts) {
  const auto scene = makeClothBesideGimpact();
  EXPECT_EQ(number(*scene, "cloth_top_m"), number(*scene, "cloth_top_gimpact_m"));
  run(*scene, 240);
  EXPECT_NEAR(number(*scene, "cloth_top_m"), 0.7, 0.08);  // the walls' 0.62, Bullet's thickness of triangles
  EXPECT_LT(number(*scene, "cloth_top_gimpact_m"), 0.2);
}

TEST(ContactSheet, isTheSameForAnyNumberOfThreadsAndHasEveryFrame) {
  const auto scene = makeHelloShape();
  std::vector<demos::SheetFrame> frames;
  for (const char* caption : {"0 s", "0.1 s", "0.2 s", "0.3 s"}) {
    frames.push_back({caption, scene->picture()});
    run(*scene, 24);
  }
  const demos::Image one = demos::contactSheet(frames, "Title", "Words", 3, 96, 80, 1),
                     two = demos::contactSheet(frames, "Title", "Words", 3, 96, 80, 2);
  EXPECT_EQ(one.pixels, two.pixels);
  EXPECT_EQ(one.width, 3 * 96 + 2 * 6);
  EXPECT_GT(one.height, 2 * 80 + 6);
  // The moving bodies are elsewhere in every frame, and the last place is empty.
  const int top = one.height - (2 * 80 + 6);
  const auto tile = [&](int column, int row) {
    std::vector<demos::Image::Pixel> pixels;
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 96; ++x) pixels.push_back(one.at(column * 102 + x, top + row * 86 + y));
    }
    return pixels;
  };
  EXPECT_NE(tile(0, 0), tile(1, 0));
  EXPECT_NE(tile(1, 0), tile(2, 0));
  EXPECT_NE(tile(2, 0), tile(0, 1));
  EXPECT_TRUE(std::ranges::all_of(tile(2, 1), [](const auto& pixel) { return pixel[0] > 200; }));
  EXPECT_THROW(demos::contactSheet({}, "", "", 3, 96, 80), std::invalid_argument);
  EXPECT_THROW(demos::contactSheet(frames, "", "", 0, 96, 80), std::invalid_argument);
}

TEST(ContactSheet, hasTheLegendOfAllFramesOnce) {
  const demos::Picture picture = makeHelloShape()->picture();
  const demos::LegendEntry floor{demos::palette::kSteel, "floor"}, ring{demos::palette::kOrange, "ring"};
  const auto sheet = [&](const std::vector<demos::LegendEntry>& first,
                         const std::vector<demos::LegendEntry>& second) {
    std::vector<demos::SheetFrame> frames = {{"", picture}, {"", picture}};
    frames[0].picture.annotation.legend = first;
    frames[1].picture.annotation.legend = second;
    return demos::contactSheet(frames, "", "", 2, 96, 80).pixels;
  };
  EXPECT_EQ(sheet({floor}, {floor, ring}), sheet({floor, ring}, {}));
  EXPECT_NE(sheet({floor}, {floor, ring}), sheet({floor}, {floor}));
}

TEST(GalleryCommand, writesASceneTheSameTwice) {
  const demos::ScratchFolder folder;
  const demos::Outcome first = demos::runOctoblisk(folder.path(), "gallery hello-shape --out a");
  ASSERT_EQ(first.exit_code, 0) << first.error;
  EXPECT_THAT(first.out, HasSubstr("a/hello-shape.png: at 2 s, ring_height_m 0.1"));
  ASSERT_EQ(demos::runOctoblisk(folder.path(), "gallery hello-shape --out b").exit_code, 0);
  for (const char* name : {"hello-shape.png", "hello-shape.csv"}) {
    EXPECT_GT(demos::contentOf(folder.path() / "a" / name).size(), 500u);
    EXPECT_EQ(demos::contentOf(folder.path() / "a" / name), demos::contentOf(folder.path() / "b" / name))
        << name;
  }
  const demos::Outcome unknown = demos::runOctoblisk(folder.path(), "gallery shape --out a");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.error,
              HasSubstr("octoblisk: 'shape' is not a scene; the scenes are: hello-shape, chain-of-tori"));
}

}  // namespace
}  // namespace octoblisk::gallery
