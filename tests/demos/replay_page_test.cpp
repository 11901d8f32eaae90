// Reads back the page of a replay and the run in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "demos/command.h"
#include "demos/packed_numbers.h"
#include "demos/scratch_folder.h"
#include "demos/small_replay.h"
#include "models/blisk.h"
#include "models/shared_tree.h"
#include "report/replay_files.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(ReplayPage, runReadsBackAsItWas) {
  const Replay replay = smallReplay();
  const auto run = nlohmann::json::parse(replayJson(replay, replayMeshesOf(replay)));
  EXPECT_EQ(run["command"], "grind");
  EXPECT_EQ(run["verdicts"][1]["tone"], "interference");
  const auto& track = run["tracks"][0];
  EXPECT_EQ(numbersOf<std::uint8_t>(decoded(track["verdict"])), (std::vector<std::uint8_t>{0, 1, 0}));
  const auto poses = numbersOf<float>(decoded(track["poses"]));
  ASSERT_EQ(poses.size(), 21u);
  EXPECT_FLOAT_EQ(poses[7], 1.5f);
  EXPECT_NEAR(std::abs(poses[10]), std::cos(1.25), 1e-6);  // w of the second turn
  EXPECT_EQ(numbersOf<std::uint32_t>(decoded(track["contacts"]["first"])),
            (std::vector<std::uint32_t>{0, 0, 2, 2}));
  const auto points = numbersOf<float>(decoded(track["contacts"]["points"]));
  EXPECT_EQ(points, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  const auto series = numbersOf<float>(decoded(track["series"][0]["values"]));
  EXPECT_EQ(series[0], 1.0f);
  EXPECT_TRUE(std::isnan(series[2]));
  EXPECT_EQ(track["findings"][0], nlohmann::json({1.0, 1, 0, 2, 1, 0.25, -1}));
  EXPECT_EQ(track["findings"][1], nlohmann::json({1.5, 1, -1, -1, 0, nullptr, 2}));

  // The mesh in 16-bit steps, accurate to half a step.
  const auto& mesh = run["blisk"]["mesh"];
  const auto steps = numbersOf<std::uint16_t>(decoded(mesh["vertices"]));
  const auto corners = numbersOf<std::uint32_t>(decoded(mesh["triangles"]));
  ASSERT_EQ(corners.size(), 3 * replay.blisk->mesh().triangleCount());
  double volume = 0.0;
  const auto vertex = [&](std::uint32_t v) {
    Vec3 at;
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = mesh["box"][k], high = mesh["box"][k + 3];
      at[static_cast<Eigen::Index>(k)] = low + steps[3 * v + k] / 65535.0 * (high - low);
    }
    return at;
  };
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    volume += vertex(corners[t]).dot(vertex(corners[t + 1]).cross(vertex(corners[t + 2]))) / 6.0;
  }
  EXPECT_NEAR(volume, 10.0 * 20.0 * 30.0, 1.0);
  std::size_t grouped = 0;
  for (const auto& group : run["blisk"]["groups"]) {
    EXPECT_EQ(group[1], grouped);
    grouped += group[2].get<std::size_t>();
  }
  EXPECT_EQ(grouped, replay.blisk->mesh().triangleCount());
}

TEST(ReplayPage, namesCannotEndTheScript) {
  const std::string evil = "</script><script>alert(1)</script><!-- \xff \" \\ \xe2\x80\xa8";
  const Replay replay = smallReplay(evil);
  const ReplayMeshes meshes = replayMeshesOf(replay);
  const std::string json = replayJson(replay, meshes);
  EXPECT_EQ(json.find('<'), std::string::npos);
  const auto run = nlohmann::json::parse(json);
  const std::string name = run["parts"][0]["name"];
  EXPECT_THAT(name,
              StartsWith("</script><script>alert(1)</script><!-- "));  // unchanged except for invalid UTF-8

  const ScratchFolder folder;
  writeReplayPage(replay, meshes, folder.path() / "report.html");
  const std::string page = contentOf(folder.path() / "report.html");
  EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(page, Not(HasSubstr("alert(1)</script>")));
  EXPECT_THAT(page, Not(HasSubstr("@@RUN@@")));
  EXPECT_THAT(page, HasSubstr("MIT License"));
  const std::string opening = "<script type=\"application/json\" id=\"run\">";
  const std::size_t begin = page.find(opening) + opening.size();
  EXPECT_EQ(nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin)), run);
}

TEST(ReplayPage, saysWhatItLeavesOut) {
  Replay replay = smallReplay();
  replay.blisk = treeOf(makeDefaultBlisk(10'000).mesh);
  replay.blade_of_triangle.assign(replay.blisk->mesh().triangleCount(), 0);
  EXPECT_TRUE(nlohmann::json::parse(replayJson(replay, replayMeshesOf(replay)))["notes"].empty());
  const ReplayMeshes meshes = replayMeshesOf(replay, {.blisk = 2'000, .part = 100});
  const ReplayLimits limits{.boxes = 500, .contacts = 3};
  const auto run = nlohmann::json::parse(replayJson(replay, meshes, limits));
  ASSERT_EQ(run["notes"].size(), 2u);
  EXPECT_THAT(run["notes"][0].get<std::string>(), HasSubstr("Simplified for display: the blisk"));
  EXPECT_THAT(run["notes"][1].get<std::string>(), HasSubstr("Cluster boxes below level"));
  EXPECT_LE(decoded(run["blisk"]["mesh"]["triangles"]).size(), 2'000u * 12);
  EXPECT_LE(decoded(run["boxes"]["depths"]).size(), 500u);

  replay.tracks[0].poses[1].contacts.resize(10, replay.tracks[0].poses[1].contacts[1]);
  const auto fewer = nlohmann::json::parse(replayJson(replay, meshes, limits));
  EXPECT_EQ(fewer["notes"].size(), 3u);
  // The one remaining contact is the worst.
  EXPECT_EQ(numbersOf<std::uint8_t>(decoded(fewer["tracks"][0]["contacts"]["verdict"])),
            std::vector<std::uint8_t>{1});
}

}  // namespace
}  // namespace octoblisk::demos
