// Tool files: reading, writing, and the messages for invalid files.
#include "grinding/tool_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demos/block.h"
#include "demos/scratch_folder.h"
#include "grinding/tool_assembly.h"
#include "io/mesh_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Kind = BladeChoice::Kind;

class ToolFiles : public ::testing::Test {
 protected:
  ToolFiles() {
    writeMesh(folder_.path() / "belt.ply", block({1, 1, 1}, 1));
    writeMesh(folder_.path() / "arm.ply", block({1, 2, 3}, 1));
  }
  std::filesystem::path write(const std::string& content) { return folder_.write("tool.json", content); }

  ScratchFolder folder_;
};

const std::string kGood = R"({
  "parts": [{"name": "belt", "mesh": "belt.ply", "max_depth_mm": 0.2, "belt_speed_m_s": -30},
    {"name": "arm", "mesh": "arm.ply"}],
  "allowed": [{"part": "belt", "blade": "ground"}, {"part": "any", "blade": 7}],
  "margins": [{"part": "any", "blade": "any", "near_miss_mm": 1}, {"part": "arm", "blade": "hub", "near_miss_mm": 2.5}]
})";

TEST_F(ToolFiles, areReadAndWritten) {
  const auto expectGood = [&](const ToolFile& tool) {
    ASSERT_EQ(tool.parts.size(), 2u);
    EXPECT_EQ(tool.parts[0].name, "belt");
    EXPECT_EQ(tool.parts[0].max_depth, 0.2);
    EXPECT_EQ(tool.parts[1].max_depth, std::nullopt);
    EXPECT_EQ(tool.parts[0].belt_speed, -30.0);
    EXPECT_EQ(tool.parts[1].belt_speed, std::nullopt);
    ASSERT_EQ(tool.allowed.size(), 2u);
    EXPECT_EQ(tool.allowed[0].part, 0u);
    EXPECT_EQ(tool.allowed[0].blade.kind, Kind::ground);
    EXPECT_EQ(tool.allowed[1].part, std::nullopt);
    EXPECT_EQ(tool.allowed[1].blade.number, 7);
    ASSERT_EQ(tool.margins.size(), 2u);
    EXPECT_EQ(tool.margins[1].part, 1u);
    EXPECT_EQ(tool.margins[1].blade.kind, Kind::hub);
    EXPECT_EQ(tool.margins[1].near_miss, 2.5);
  };
  ToolFile tool = readToolFile(write(kGood));
  expectGood(tool);
  EXPECT_EQ(tool.parts[0].mesh, folder_.path() / "belt.ply");
  for (ToolFilePart& part : tool.parts) part.mesh = part.mesh.filename();
  writeToolFile(folder_.path() / "again.json", tool);
  expectGood(readToolFile(folder_.path() / "again.json"));
}

TEST_F(ToolFiles, rulesAreThoseOfTheRows) {
  VerdictRules rules = toolOf(write(kGood), 0.1).rules;
  rules.ground_blade = 3;
  rules.near_miss = 0.5;
  EXPECT_EQ(rules.grinding_part, 0u);
  EXPECT_TRUE(rules.allows(0, 3));
  EXPECT_FALSE(rules.allows(1, 3));
  EXPECT_TRUE(rules.allows(1, 7));
  EXPECT_FALSE(rules.allows(0, 0));
  EXPECT_EQ(rules.maxDepth(0), 0.2);
  EXPECT_EQ(rules.maxDepth(1), 0.1);
  EXPECT_EQ(rules.margin(1, 0), 2.5) << "the last row counts";
  EXPECT_EQ(rules.margin(1, 4), 1.0);
  EXPECT_EQ(greatestBladeNamed(rules), 7);
}

TEST_F(ToolFiles, whatIsWrongIsNamed) {
  const std::string belt = R"({"name": "belt", "mesh": "belt.ply"})";
  const auto parts = [](const std::string& list) { return "{\"parts\": [" + list + "]}"; };
  const auto row = [&](const std::string& table, const std::string& content) {
    return "{\"parts\": [" + belt + "], \"" + table + "\": [" + content + "]}";
  };
  const std::pair<std::string, const char*> cases[] = {
      {"", ":1: not valid JSON"},
      {"{\n\"parts\": [,]}", ":2: not valid JSON"},
      {"[]", ": must be an object"},
      {"{}", ": the key \"parts\" is missing"},
      {parts(""), ": parts: must have at least one part"},
      {R"({"parts": {}})", ": parts: must be a list"},
      {R"({"parts": [], "speed": 1})", ": unknown key 'speed'; the keys are: parts, allowed, margins"},
      {R"({"parts": [], "parts": []})", ": the key 'parts' is repeated"},
      {parts(R"({"name": "belt"})"), ": parts[0]: the key \"mesh\" is missing"},
      {parts(R"({"name": "belt", "mesh": "none.ply"})"), "none.ply: no such file"},
      {parts(R"({"name": "belt", "mesh": "none.ply"})"), ": parts[0].mesh: "},
      {parts(R"({"name": "belt", "mesh": 3})"), ": parts[0].mesh: must be text"},
      {parts(R"({"name": "belt", "mesh": ""})"), ": parts[0].mesh: the name is empty"},
      {parts(R"({"name": "belt", "mesh": "belt.ply\u0000"})"),
       ": parts[0].mesh: a file name must not contain"},
      {parts(R"({"name": "belt", "mesh": "no\nbelt.ply"})"), ": parts[0].mesh: a file name must not contain"},
      {parts(R"({"name": "a,b", "mesh": "belt.ply"})"), ": parts[0].name: a name must consist"},
      {parts(R"({"name": "any", "mesh": "belt.ply"})"), ": parts[0].name: this name is reserved"},
      {parts(R"({"name": "belt", "mesh": "belt.ply", "max_depth_mm": -1})"),
       ": parts[0].max_depth_mm: must be a number from 0 to"},
      {parts(R"({"name": "belt", "mesh": "belt.ply", "max_depth_mm": "1"})"), ": must be a number"},
      {parts(R"({"name": "belt", "mesh": "belt.ply", "max_depth_mm": 1e999})"), ": a number is too large"},
      {parts(belt + "," + belt), ": parts[1].name: two parts are named 'belt'"},
      {row("allowed", R"({"part": "arm", "blade": 1})"), ": allowed[0].part: no part is named 'arm'"},
      {row("allowed", R"({"part": "belt", "blade": 0})"), ": allowed[0].blade: must be a number from 1"},
      {row("allowed", R"({"part": "belt", "blade": 1.5})"), ": allowed[0].blade: must be a blade number"},
      {row("allowed", R"({"part": "belt", "blade": "tip"})"), ": allowed[0].blade: must be a blade number"},
      {row("margins", R"({"part": "belt", "blade": 1})"),
       ": margins[0]: the key \"near_miss_mm\" is missing"},
      {row("margins", R"({"part": "belt", "blade": 1, "near_miss_mm": -0.1})"),
       ": margins[0].near_miss_mm: must be a number from 0 to 5"}};
  for (const auto& [content, expected] : cases) {
    const std::filesystem::path file = write(content);
    const std::string message = messageOf<std::runtime_error>([&] { readToolFile(file); });
    EXPECT_THAT(message, StartsWith(file.string())) << content;
    EXPECT_THAT(message, HasSubstr(expected)) << content;
  }
  EXPECT_THAT(messageOf<std::runtime_error>([&] { readToolFile(folder_.path() / "none.json"); }),
              HasSubstr("none.json: no such file"));
  folder_.write("bad.ply", "no mesh");
  EXPECT_THAT(messageOf<std::runtime_error>(
                  [&] { toolOf(write(parts(R"({"name": "belt", "mesh": "bad.ply"})")), 0.1); }),
              HasSubstr(": parts[0].mesh: "));
}

}  // namespace
}  // namespace octoblisk::demos
