// Parses the glTF file of a replay.
#include "report/run_glb.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "demos/packed_numbers.h"
#include "demos/small_replay.h"

namespace octoblisk::demos {
namespace {

/// A parsed binary glTF file.
struct Glb {
  explicit Glb(const std::string& file) {
    const auto words = numbersOf<std::uint32_t>(file.substr(0, 20));
    EXPECT_EQ(words[0], 0x46546C67u);
    EXPECT_EQ(words[1], 2u);
    EXPECT_EQ(words[2], file.size());
    EXPECT_EQ(words[3] % 4, 0u);
    EXPECT_EQ(words[4], 0x4E4F534Au);
    json = nlohmann::json::parse(file.substr(20, words[3]));
    const auto chunk = numbersOf<std::uint32_t>(file.substr(20 + words[3], 8));
    EXPECT_EQ(chunk[1], 0x004E4942u);
    buffer = file.substr(28 + words[3]);
    EXPECT_EQ(chunk[0], buffer.size());
    EXPECT_EQ(json["buffers"][0]["byteLength"], buffer.size());
  }

  template <typename Number>
  std::vector<Number> read(std::size_t accessor) const {
    const auto& a = json["accessors"][accessor];
    const auto& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
    const std::size_t bytes = a["count"].get<std::size_t>() * widths.at(a["type"]) * sizeof(Number);
    const std::size_t offset = a.value("byteOffset", std::size_t{0});
    EXPECT_LE(offset + bytes, view["byteLength"].get<std::size_t>());
    return numbersOf<Number>(buffer.substr(view["byteOffset"].get<std::size_t>() + offset, bytes));
  }

  nlohmann::json json;
  std::string buffer;
};

TEST(RunGlb, holdsMeshesByBladeWithTheirBounds) {
  const Replay replay = smallReplay();
  const Glb glb(glbOf(replay, replayMeshesOf(replay)));
  std::set<std::string> names;
  for (const auto& node : glb.json["nodes"]) names.insert(node["name"]);
  EXPECT_EQ(names, (std::set<std::string>{"blisk", "part", "tool", "contacts: clear",
                                          "contacts: interference", "octoblisk grind"}));
  std::size_t bounded = 0;
  for (std::size_t a = 0; a < glb.json["accessors"].size(); ++a) {
    const auto& accessor = glb.json["accessors"][a];
    if (!accessor.contains("min")) continue;
    ++bounded;
    const auto values = glb.read<float>(a);
    const std::size_t width = accessor["min"].size();
    for (std::size_t k = 0; k < width; ++k) {
      float low = values[k], high = values[k];
      for (std::size_t i = k; i < values.size(); i += width) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      EXPECT_EQ(accessor["min"][k], low);
      EXPECT_EQ(accessor["max"][k], high);
    }
  }
  EXPECT_EQ(bounded, 5u);  // blisk, part, times, contacts of two verdicts

  const auto& blisk = glb.json["meshes"][0];
  ASSERT_EQ(blisk["primitives"].size(), 3u);  // hub, two blades
  std::size_t corners = 0;
  std::set<std::size_t> materials;
  for (const auto& primitive : blisk["primitives"]) {
    const auto indices = glb.read<std::uint32_t>(primitive["indices"]);
    corners += indices.size();
    const std::size_t vertices =
        glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"];
    EXPECT_LT(std::ranges::max(indices), vertices);
    materials.insert(primitive["material"].get<std::size_t>());
  }
  EXPECT_EQ(corners, 3 * replay.blisk->mesh().triangleCount());
  EXPECT_EQ(materials.size(), 3u);
}

TEST(RunGlb, movesTheToolFromPoseToPose) {
  const Replay replay = smallReplay();
  const Glb glb(glbOf(replay, replayMeshesOf(replay), {.poses_per_second = 4.0}));
  ASSERT_EQ(glb.json["animations"].size(), 1u);
  const auto& animation = glb.json["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 2u);
  std::map<std::string, std::size_t> samplers;
  for (const auto& channel : animation["channels"]) {
    const std::size_t node = channel["target"]["node"];
    EXPECT_EQ(glb.json["nodes"][node]["name"], "tool");
    samplers[channel["target"]["path"]] = channel["sampler"];
  }
  const auto& place = animation["samplers"][samplers.at("translation")];
  const auto& turn = animation["samplers"][samplers.at("rotation")];
  EXPECT_EQ(glb.read<float>(place["input"]), (std::vector<float>{0.0f, 0.25f, 0.5f}));
  EXPECT_EQ(glb.read<float>(place["output"]), (std::vector<float>{0, -2, 40, 1.5, -2, 40, 3, -2, 40}));
  const auto turns = glb.read<float>(turn["output"]);
  ASSERT_EQ(turns.size(), 12u);
  for (std::size_t p = 0; p < 3; ++p) {
    const Eigen::Quaterniond q(turns[4 * p + 3], turns[4 * p], turns[4 * p + 1], turns[4 * p + 2]);
    EXPECT_NEAR(q.norm(), 1.0, 1e-6);
    EXPECT_TRUE(q.toRotationMatrix().isApprox(replay.tracks[0].poses[p].tool_in_blisk.rotation, 1e-6));
    if (p == 0) continue;
    double dot = 0.0;  // positive for the shorter turn
    for (std::size_t k = 0; k < 4; ++k) dot += double{turns[4 * p + k]} * turns[4 * p - 4 + k];
    EXPECT_GE(dot, 0.0) << p;
  }
  EXPECT_THROW(glbOf(replay, replayMeshesOf(replay), {.poses_per_second = 0.0}), std::invalid_argument);
}

TEST(RunGlb, contactsAreClosedMarksFacingOutward) {
  const Replay replay = smallReplay();
  const Glb glb(glbOf(replay, replayMeshesOf(replay)));
  for (const auto& mesh : glb.json["meshes"]) {
    if (mesh["name"] != "contacts: interference") continue;
    const auto& primitive = mesh["primitives"][0];
    const auto positions = glb.read<float>(primitive["attributes"]["POSITION"]);
    const auto indices = glb.read<std::uint32_t>(primitive["indices"]);
    ASSERT_EQ(indices.size(), 24u);
    double volume = 0.0;
    const auto at = [&](std::size_t i) {
      return Vec3(positions[3 * indices[i]], positions[3 * indices[i] + 1], positions[3 * indices[i] + 2]);
    };
    for (std::size_t i = 0; i < indices.size(); i += 3) volume += at(i).dot(at(i + 1).cross(at(i + 2))) / 6.0;
    EXPECT_NEAR(volume, 4.0 / 3.0 * 0.3 * 0.3 * 0.3, 1e-5);  // of an octahedron of that radius
    return;
  }
  FAIL() << "no contacts of interference";
}

}  // namespace
}  // namespace octoblisk::demos
