#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "demos/scratch_folder.h"
#include "demos/surface_checks.h"
#include "models/belt_grinder.h"
#include "models/blade_sections.h"
#include "models/blade_surface.h"
#include "models/blisk.h"
#include "models/orientation.h"
#include "models/radius_profile.h"

namespace octoblisk::demos {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr int kBladeCount = 24;
constexpr double kHubRadius = 128.0;
constexpr double kTipRadius = 240.0;
const RadiusProfile kHub = cylinderProfile(kHubRadius, 100.0);

Vec3 turned(const Vec3& point, double angle) { return Eigen::AngleAxisd(angle, Vec3::UnitZ()) * point; }

std::string csvOf(const SectionLoop& loop, bool repeat_first) {
  std::ostringstream text;
  text << "x,y,z\n" << std::setprecision(17);
  for (const Vec3& point : loop) text << point.x() << ", " << point.y() << "," << point.z() << "\r\n";
  if (repeat_first) text << loop[0].x() << ',' << loop[0].y() << ',' << loop[0].z() << '\n';
  return text.str();
}

TEST(Blisk, isWatertightAndFillsTheCheckedVolumeAtEveryResolution) {
  for (const std::size_t target : {10'000u, 50'000u, 300'000u}) {
    const Blisk blisk = makeDefaultBlisk(target);
    const double count = static_cast<double>(blisk.mesh.triangleCount());
    EXPECT_NEAR(count / static_cast<double>(target), 1.0, 0.15) << target;
    EXPECT_EQ(2.0 * blisk.mesh.bounds().halfExtents(), Vec3(480.0, 480.0, 200.0)) << target;
    EXPECT_GT(enclosedVolume(blisk.mesh), 8.8e6) << target;
    EXPECT_LT(enclosedVolume(blisk.mesh), 9.0e6) << target;
    EXPECT_TRUE(isWatertight(blisk.mesh)) << target;
    EXPECT_EQ(eulerCharacteristic(blisk.mesh), 0) << "genus 1: the bore";
  }
}

TEST(Blisk, meetsTheTargetOverItsWholeRange) {
  for (double target = 10'000; target <= 5e6; target *= 1.37) {
    const Blisk blisk = makeDefaultBlisk(static_cast<std::size_t>(target));
    EXPECT_NEAR(static_cast<double>(blisk.mesh.triangleCount()) / target, 1.0, 0.15);
  }
}

TEST(Blisk, hasNoTrianglesThatCross) {
  EXPECT_EQ(countCrossings(makeDefaultBlisk(10'000).mesh), 0u);
  BliskOptions shrouded;
  shrouded.shroud = true;
  shrouded.target_triangles = 12'000;
  EXPECT_EQ(countCrossings(makeBlisk(makeBladeSections({}), kHub, shrouded).mesh), 0u);
}

TEST(Blisk, crossingsAreFoundWhereTheyAre) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 9}};
  EXPECT_EQ(countCrossings(TriangleMesh(vertices, {{0, 1, 2}, {3, 4, 5}})), 1u);
}

TEST(Blisk, shroudJoinsTheTips) {
  BliskOptions options;
  options.shroud = true;
  options.target_triangles = 50'000;
  const Blisk blisk = makeBlisk(makeBladeSections({}), kHub, options);
  EXPECT_NEAR(static_cast<double>(blisk.mesh.triangleCount()), 50'000.0, 7'500.0);
  EXPECT_TRUE(isWatertight(blisk.mesh));
  EXPECT_GT(enclosedVolume(blisk.mesh), enclosedVolume(makeDefaultBlisk(50'000).mesh));
  // Two rings and 24 blades between them: genus 1 + 24.
  EXPECT_EQ(eulerCharacteristic(blisk.mesh), 2 - 2 * (1 + kBladeCount));
  EXPECT_NEAR(blisk.mesh.bounds().max.x(), kTipRadius + options.shroud_thickness, 1e-9);
}

TEST(Blisk, rootsLieOnTheHubAndBladesAreNumbered) {
  const Blisk blisk = makeDefaultBlisk(20'000);
  const TriangleMesh& mesh = blisk.mesh;
  ASSERT_EQ(blisk.blade_of_triangle.size(), mesh.triangleCount());
  std::map<int, Vec3> blade_sum;
  std::map<int, int> blade_triangles;
  std::vector<bool> on_blade(mesh.vertices().size()), on_hub(mesh.vertices().size());
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const int blade = blisk.blade_of_triangle[t];
    for (const std::uint32_t vertex : mesh.triangles()[t]) (blade ? on_blade : on_hub)[vertex] = true;
    if (!blade) continue;
    blade_sum.try_emplace(blade, Vec3::Zero()).first->second += mesh.triangle(t)[0];
    ++blade_triangles[blade];
  }
  ASSERT_EQ(blade_triangles.size(), static_cast<std::size_t>(kBladeCount));
  for (int blade = 1; blade <= kBladeCount; ++blade) {
    EXPECT_EQ(blade_triangles[blade], blade_triangles[1]);
    const double pitch = 2.0 * std::numbers::pi / kBladeCount;
    EXPECT_LT((blade_sum[blade] - turned(blade_sum[1], (blade - 1) * pitch)).norm(), 1e-6);
  }
  int roots = 0;
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v) {
    const double radius = mesh.vertices()[v].head<2>().norm();
    EXPECT_TRUE(!on_blade[v] || radius >= kHubRadius - 1e-9) << radius;
    EXPECT_TRUE(!on_hub[v] || radius <= kHubRadius + 1e-9) << radius;
    if (on_blade[v] && on_hub[v]) ++roots;
  }
  EXPECT_EQ(roots % kBladeCount, 0);
  EXPECT_GT(roots, kBladeCount * 12);
}

TEST(Blisk, repeatsFromBladeToBlade) {
  const TriangleMesh mesh = makeDefaultBlisk(10'000).mesh;
  const std::size_t vertices_in_sector = mesh.vertices().size() / kBladeCount;
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v) {
    const Vec3 expected = turned(mesh.vertices()[v], 2.0 * std::numbers::pi / kBladeCount);
    const Vec3& next = mesh.vertices()[(v + vertices_in_sector) % mesh.vertices().size()];
    ASSERT_LT((next - expected).norm(), 1e-9) << v;
  }
}

TEST(Blisk, channelsTakeTheBelt) {
  const BladeGrid blade = sampleBlade(makeBladeSections({}), kHub, nullptr, 60, 20);
  const int middle_row = 10;
  double width = 1e9;
  for (int i = 0; i <= 60; ++i) {
    const Vec3 forward = toCartesian(blade.at(BladeSide::forward, middle_row, i));
    for (int row = 0; row <= 20; ++row) {
      for (int j = 0; j <= 60; ++j) {
        CylindricalPoint next = blade.at(BladeSide::backward, row, j);
        next.angle += 2.0 * std::numbers::pi / kBladeCount;
        width = std::min(width, (toCartesian(next) - forward).norm());
      }
    }
  }
  EXPECT_GE(width, 20.0);
}

TEST(Blisk, smoothlyRefinesTheSameBlade) {
  const auto sections = makeBladeSections({});
  const BladeGrid coarse = sampleBlade(sections, kHub, nullptr, 10, 8);
  const BladeGrid fine = sampleBlade(sections, kHub, nullptr, 40, 32);
  for (int row = 0; row <= 8; ++row) {
    for (int station = 0; station <= 10; ++station) {
      const Vec3 a = toCartesian(coarse.at(BladeSide::forward, row, station));
      const Vec3 b = toCartesian(fine.at(BladeSide::forward, 4 * row, 4 * station));
      EXPECT_LT((a - b).norm(), 1e-9);
    }
  }
}

TEST(Blisk, takesHubsAndBladesOfOtherShapes) {
  BladeParameters parameters;
  parameters.hub_radius = 90.0;
  parameters.tip_radius = 250.0;
  parameters.stagger_hub = -10.0;
  parameters.stagger_tip = -62.0;
  parameters.chord_hub = parameters.chord_tip = 95.0;
  const RadiusProfile cone({{-70.0, 88.0}, {0.0, 100.0}, {75.0, 115.0}});  // clips the roots
  const RadiusProfile thin({{-70.0, 84.0}, {75.0, 88.0}});  // the roots are extended down to it
  BliskOptions options;
  options.blade_count = 22;
  for (const RadiusProfile& hub : {cone, thin}) {
    for (const bool shroud : {false, true}) {
      options.shroud = shroud;
      options.target_triangles = 20'000;
      const Blisk blisk = makeBlisk(makeBladeSections(parameters), hub, options);
      EXPECT_TRUE(isWatertight(blisk.mesh));
      EXPECT_GT(enclosedVolume(blisk.mesh), 0.0);
      EXPECT_EQ(countCrossings(blisk.mesh), 0u);
    }
  }
}

TEST(Blisk, refusesWhatMakesNoBlisk) {
  const auto refusal = [](auto change) {
    return messageOf<std::invalid_argument>([&] {
      BladeParameters blade;
      BliskOptions options;
      double half_length = 100.0;
      change(blade, options, half_length);
      makeBlisk(makeBladeSections(blade), cylinderProfile(blade.hub_radius, half_length), options);
    });
  };
  using Blade = BladeParameters&;
  using Options = BliskOptions&;
  using Half = double&;
  EXPECT_THAT(refusal([](Blade b, Options, Half) { b.hub_radius = -1.0; }), HasSubstr("hub radius"));
  EXPECT_THAT(refusal([](Blade b, Options, Half) { b.tip_radius = 100.0; }), HasSubstr("tip radius"));
  EXPECT_THAT(refusal([](Blade b, Options, Half) { b.chord_tip = 0.0; }), HasSubstr("chord"));
  EXPECT_THAT(refusal([](Blade b, Options, Half) { b.thickness_hub = std::nan(""); }),
              HasSubstr("thickness"));
  EXPECT_THAT(refusal([](Blade b, Options, Half) { b.edge_radius = 2.0; }), HasSubstr("edge radius"));
  EXPECT_THAT(refusal([](Blade b, Options, Half) { b.section_count = 1; }), HasSubstr("number of sections"));
  EXPECT_THAT(refusal([](Blade, Options, Half h) { h = 0.0; }), HasSubstr("hub length"));
  EXPECT_THAT(refusal([](Blade, Options, Half h) { h = 40.0; }), HasSubstr("reach beyond the hub"));
  EXPECT_THAT(refusal([](Blade, Options o, Half) { o.bore_radius = 0.0; }), HasSubstr("bore radius"));
  EXPECT_THAT(refusal([](Blade, Options o, Half) { o.bore_radius = 130.0; }), HasSubstr("bore radius"));
  EXPECT_THAT(refusal([](Blade, Options o, Half) { o.blade_count = 1; }), HasSubstr("number of blades"));
  EXPECT_THAT(refusal([](Blade, Options o, Half) { o.blade_count = 170; }),
              HasSubstr("adjacent blades touch"));
  EXPECT_THAT(refusal([](Blade, Options o, Half) { o.target_triangles = 500; }), HasSubstr("at least"));
  EXPECT_THAT(refusal([](Blade, Options o, Half) {
                o.shroud = true;
                o.shroud_thickness = 0.0;
              }),
              HasSubstr("shroud thickness"));

  const BladeSections sections = makeBladeSections({});
  const auto refusedHub = [&](double radius) {
    BliskOptions options;
    return messageOf<std::invalid_argument>(
        [&] { makeBlisk(sections, cylinderProfile(radius, 100.0), options); });
  };
  EXPECT_THAT(refusedHub(250.0), HasSubstr("tip lies below the hub"));
  EXPECT_THAT(refusedHub(70.0), HasSubstr("outside the hub surface"));
}

TEST(BladeSections, comeBackFromAFolderAndBuildTheSameBlisk) {
  const ScratchFolder folder;
  const BladeSections sections = makeBladeSections({});
  ASSERT_GT(sections.loops.size(), 10u);
  for (std::size_t s = 0; s < sections.loops.size(); ++s) {
    folder.write("section_" + std::to_string(s + 1) + ".csv", csvOf(sections.loops[s], s % 2 == 0));
  }
  folder.write("notes.txt", "not a section");
  const BladeSections read = readBladeSections(folder.path());
  ASSERT_EQ(read.loops, sections.loops) << "section_2 comes before section_10";

  const RadiusProfile hub =
      readHubProfile(folder.write("hub.profile", "z,r\n-100,128\n\n# mid\n0,128\n100,128\n"));
  const TriangleMesh mesh = makeBlisk(read, hub).mesh;
  EXPECT_EQ(mesh.vertices(), makeDefaultBlisk().mesh.vertices());
  EXPECT_EQ(mesh.triangles(), makeDefaultBlisk().mesh.triangles());
}

TEST(BladeSections, refuseBadFilesByFileAndLine) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& second_section) {
    folder.write("s1.csv", csvOf(makeBladeSections({}).loops[0], false));
    folder.write("s2.csv", second_section);
    return messageOf<std::runtime_error>([&] { readBladeSections(folder.path()); });
  };
  const auto missing = [&] { readBladeSections(folder.path() / "none"); };
  EXPECT_THAT(messageOf<std::runtime_error>(missing), AllOf(HasSubstr("none"), HasSubstr("no such folder")));
  const auto empty = [&] { readBladeSections(folder.path()); };
  EXPECT_THAT(messageOf<std::runtime_error>(empty), HasSubstr("0 .csv files"));

  EXPECT_THAT(refusal("x,y,z\n1,2,3\n1,two,3\n"), AllOf(HasSubstr("s2.csv:3: "), HasSubstr("'two'")));
  EXPECT_THAT(refusal("x,y,z\n1,2,3\n1,nan,3\n"), AllOf(HasSubstr("s2.csv:3: "), HasSubstr("'nan'")));
  EXPECT_THAT(refusal("x,y,z\n1,2,1e999\n"), AllOf(HasSubstr("s2.csv:2: "), HasSubstr("'1e999'")));
  EXPECT_THAT(refusal("x,y,z\n1,2,3,4\n"), AllOf(HasSubstr("s2.csv:2: "), HasSubstr("4 columns")));
  EXPECT_THAT(refusal("x,y,z\n1,2,3\n4,5,6\n"), AllOf(HasSubstr("s2.csv:3: "), HasSubstr("2 points")));
  EXPECT_THAT(refusal("a,b,c\n1,2,3\n"), AllOf(HasSubstr("s2.csv:1: "), HasSubstr("header")));
  EXPECT_THAT(refusal("x,y,z\n1,2,3\n1,-1e300,3\n"), AllOf(HasSubstr("s2.csv:3: "), HasSubstr("100,000 mm")));
  EXPECT_THAT(refusal(""), AllOf(HasSubstr("s2.csv:1: "), HasSubstr("empty")));
  EXPECT_THAT(refusal(csvOf(makeBladeSections({}).loops[0], false)),
              AllOf(HasSubstr("s2.csv"), HasSubstr("farther out")));
}

TEST(HubProfile, refusesBadFilesByFileAndLine) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& content) {
    const auto file = folder.write("hub.csv", content);
    return messageOf<std::runtime_error>([&] { readHubProfile(file); });
  };
  EXPECT_THAT(refusal("z,r\n0,1\n"), AllOf(HasSubstr("hub.csv:2: "), HasSubstr("two points")));
  EXPECT_THAT(refusal("z,r\n0,1\n0,2\n"), AllOf(HasSubstr("hub.csv:3: "), HasSubstr("greater")));
  EXPECT_THAT(refusal("z,r\n0,1\n1,-2\n"), AllOf(HasSubstr("hub.csv:3: "), HasSubstr("above 0")));
  EXPECT_THAT(refusal("z,r\n0,1\n1e300,2\n"), AllOf(HasSubstr("hub.csv:3: "), HasSubstr("100,000 mm")));
  EXPECT_THAT(refusal("z,r\n0\n"), AllOf(HasSubstr("hub.csv:2: "), HasSubstr("1 columns")));
  EXPECT_THAT(messageOf<std::runtime_error>([&] { readHubProfile(folder.path() / "none.csv"); }),
              HasSubstr("none.csv: no such file"));
}

TEST(BeltGrinder, beltIsThePapersCloud) {
  const TriangleMesh belt = makeBelt();
  EXPECT_EQ(belt.vertices().size(), 19'499u);
  EXPECT_EQ(belt.triangleCount(), 38'998u);
  EXPECT_TRUE(isWatertight(belt));
  EXPECT_EQ(eulerCharacteristic(belt), 0);
  // Width · thickness · the length of the line halfway through the belt.
  const double slope = std::asin(22.0 / 300.0);
  const double length = 2.0 * 300.0 * std::cos(slope) + 8.75 * (std::numbers::pi - 2.0 * slope) +
                        30.75 * (std::numbers::pi + 2.0 * slope);
  EXPECT_NEAR(enclosedVolume(belt), 20.0 * 1.5 * length, 15.0);
  EXPECT_NEAR(belt.bounds().min.x(), -9.5, 1e-12);
  EXPECT_EQ(belt.bounds().max.z(), 10.0);
}

TEST(BeltGrinder, facetsFollowTheContactWheel) {
  const TriangleMesh belt = makeBelt();
  for (std::size_t t = 0; t < belt.triangleCount(); ++t) {
    const Triangle corners = belt.triangle(t);
    const Vec3 middle = centroidOf(corners);
    if (middle.x() > -1.0) continue;
    const double radius = middle.head<2>().norm();
    EXPECT_TRUE(radius < 9.5 + 1e-9 && radius > 8.0 - 0.002) << radius;
    if (corners[0].head<2>().norm() > 9.49 && corners[1].head<2>().norm() > 9.49 &&
        corners[2].head<2>().norm() > 9.49) {
      EXPECT_GT(radius, 9.5 - 0.002);
    }
  }
}

TEST(BeltGrinder, partsAreClosedAndClearOfEachOther) {
  const std::vector<TriangleMesh> parts{makeBelt(), makeContactWheel(), makeDriveWheel(), makeArm()};
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (const TriangleMesh& part : parts) {
    EXPECT_TRUE(isWatertight(part));
    EXPECT_GT(enclosedVolume(part), 0.0);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), part.vertices().begin(), part.vertices().end());
    for (const auto& t : part.triangles()) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  EXPECT_EQ(countCrossings(TriangleMesh(vertices, triangles)), 0u);
  EXPECT_LT(parts[1].bounds().max.x(), parts[3].bounds().min.x());
  EXPECT_LT(parts[3].bounds().max.x(), parts[2].bounds().min.x());
}

TEST(BeltGrinder, refusesSizesThatMakeNoGrinder) {
  const auto refusal = [](auto change) {
    return messageOf<std::invalid_argument>([&] {
      BeltParameters parameters;
      change(parameters);
      makeBelt(parameters);
      makeArm(parameters);
    });
  };
  EXPECT_THAT(refusal([](BeltParameters& p) { p.width = 0.0; }), HasSubstr("belt width"));
  EXPECT_THAT(refusal([](BeltParameters& p) { p.wheel_distance = 30.0; }), HasSubstr("wheel distance"));
  EXPECT_THAT(refusal([](BeltParameters& p) { p.points_per_station = 3; }), HasSubstr("from 4"));
  EXPECT_THAT(refusal([](BeltParameters& p) { p.stations = 20; }), HasSubstr("more stations"));
  EXPECT_THAT(refusal([](BeltParameters& p) { p.arm_height = 25.0; }), HasSubstr("arm"));
  EXPECT_THAT(refusal([](BeltParameters& p) { p.arm_start = 290.0; }), EndsWith("drive wheel"));
}

}  // namespace
}  // namespace octoblisk::demos
