// What a replay is told in: the page's JSON, glTF and VTK, read back; and what is drawn of meshes and trees.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "demos/block.h"
#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "models/blisk.h"
#include "report/base64.h"
#include "report/display_mesh.h"
#include "report/replay_boxes.h"
#include "report/replay_page.h"
#include "report/run_glb.h"
#include "report/vtk_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A square sheet of n × n squares of side 1 in the plane z = height, facing up or down.
void addSheet(std::size_t n, double height, bool up, std::vector<Vec3>& vertices,
              std::vector<TriangleMesh::Indices>& triangles) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (std::size_t y = 0; y <= n; ++y) {
    for (std::size_t x = 0; x <= n; ++x) {
      vertices.emplace_back(static_cast<double>(x), static_cast<double>(y), height);
    }
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = first + y * row + x;
      TriangleMesh::Indices one = {a, a + 1, a + row + 1}, other = {a, a + row + 1, a + row};
      if (!up) {
        std::swap(one[1], one[2]);
        std::swap(other[1], other[2]);
      }
      triangles.push_back(one);
      triangles.push_back(other);
    }
  }
}

double areaOf(const DisplayMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += 0.5 * scaledNormal({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}).norm();
  }
  return area;
}

TEST(DisplayMesh, isTheMeshItselfByGroupsWhereThatIsSmallEnough) {
  const TriangleMesh mesh = block(Vec3(0.5, 1.0, 1.5), 2);
  std::vector<int> groups;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) groups.push_back(t % 2 == 0 ? 7 : 3);
  const DisplayMesh drawn = displayMeshOf(mesh, groups, mesh.triangleCount());
  EXPECT_EQ(drawn.merged_within, 0.0);
  ASSERT_EQ(drawn.triangles.size(), mesh.triangleCount());
  ASSERT_EQ(drawn.groups.size(), 2u);
  EXPECT_EQ(drawn.groups[0].number, 3);
  EXPECT_EQ(drawn.groups[1].number, 7);
  EXPECT_EQ(drawn.groups[0].count + drawn.groups[1].count, mesh.triangleCount());
  EXPECT_EQ(drawn.groups[1].first, drawn.groups[0].count);
  // The triangles of group 3 are the odd ones, in their order.
  for (std::size_t i = 0; i < drawn.groups[0].count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(drawn.vertices[drawn.triangles[i][k]], mesh.triangle(2 * i + 1)[k]);
    }
  }
  EXPECT_THROW(displayMeshOf(mesh, std::vector<int>(3), 100), std::invalid_argument);
  EXPECT_THROW(displayMeshOf(mesh, {}, 0), std::invalid_argument);
}

TEST(DisplayMesh, thinnedSheetsKeepTheirPlanesAndStayApart) {
  // Two sheets nearer to each other than the cubes are wide, back to back as the sides of a blade.
  constexpr std::size_t kSide = 60;
  constexpr double kThick = 0.25;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  addSheet(kSide, kThick, true, vertices, triangles);
  addSheet(kSide, 0.0, false, vertices, triangles);
  const TriangleMesh mesh(vertices, triangles);
  const std::size_t most = mesh.triangleCount() / 6;
  const DisplayMesh drawn = displayMeshOf(mesh, {}, most);
  EXPECT_LE(drawn.triangles.size(), most);
  EXPECT_GT(drawn.triangles.size(), most / 3);
  EXPECT_GT(drawn.merged_within, kThick);
  std::size_t above = 0;
  for (const auto& [a, b, c] : drawn.triangles) {
    const Triangle corners = {drawn.vertices[a], drawn.vertices[b], drawn.vertices[c]};
    // No triangle joins the sheets, and each faces as its sheet does.
    ASSERT_EQ(corners[0].z(), corners[1].z());
    ASSERT_EQ(corners[0].z(), corners[2].z());
    const bool is_above = corners[0].z() == kThick;
    above += is_above;
    EXPECT_GT(scaledNormal(corners).z() * (is_above ? 1.0 : -1.0), 0.0);
  }
  EXPECT_GT(above, drawn.triangles.size() / 3);
  EXPECT_LT(above, drawn.triangles.size() * 2 / 3);
  const double whole = 2.0 * kSide * kSide;
  EXPECT_GT(areaOf(drawn), 0.9 * whole);  // but for the rim
  EXPECT_LE(areaOf(drawn), whole * (1.0 + 1e-9));
}

TEST(DisplayMesh, thinnedBliskHasItsBladesAndItsOwnVertices) {
  const Blisk blisk = makeDefaultBlisk(10'000);
  const DisplayMesh drawn = displayMeshOf(blisk.mesh, blisk.blade_of_triangle, 3'000);
  EXPECT_LE(drawn.triangles.size(), 3'000u);
  EXPECT_GT(drawn.triangles.size(), 1'000u);
  ASSERT_EQ(drawn.groups.size(), 25u);  // hub and blades
  std::set<std::array<double, 3>> whole;
  for (const Vec3& v : blisk.mesh.vertices()) whole.insert({v.x(), v.y(), v.z()});
  for (const Vec3& v : drawn.vertices) EXPECT_TRUE(whole.contains({v.x(), v.y(), v.z()}));
}

TEST(ReplayBoxes, haveTheBoxesOfEachLevelAsTheTreeTells) {
  const auto tree =
      ClusteredOctree::build(std::make_shared<const TriangleMesh>(makeDefaultBlisk(10'000).mesh));
  const std::vector<Vec3> places = {tree.mesh().vertices().front()};
  const ReplayBoxes all = replayBoxesOf(tree, places, 1'000'000);
  EXPECT_EQ(all.deepest, all.whole_to);
  EXPECT_EQ(all.deepest + 1, tree.stats().depth);
  for (int depth = 0; depth <= all.deepest; ++depth) {
    std::size_t shown = 0;
    double volume = 0.0, expected_volume = 0.0;
    for (const ReplayBox& each : all.boxes) {
      if (each.depth != depth && !(each.is_leaf && each.depth < depth)) continue;
      ++shown;
      volume += each.box.volume();
    }
    const std::vector<Obb> expected = tree.boxes(depth);
    for (const Obb& box : expected) expected_volume += box.volume();
    EXPECT_EQ(shown, expected.size()) << "depth " << depth;
    EXPECT_NEAR(volume, expected_volume, 1e-9 * expected_volume) << "depth " << depth;
  }

  const std::size_t most = all.boxes.size() / 3;
  const ReplayBoxes some = replayBoxesOf(tree, places, most);
  EXPECT_LE(some.boxes.size(), most);
  EXPECT_GT(some.boxes.size(), most / 2);
  EXPECT_LT(some.whole_to, some.deepest);
  const int deepest_shown = std::ranges::max(some.boxes, {}, &ReplayBox::depth).depth;
  EXPECT_GT(deepest_shown, some.whole_to);
  // What is left of the leaves is nearer to the place than what is not.
  double farthest = 0.0, mean = 0.0;
  std::size_t leaves = 0;
  for (const ReplayBox& each : some.boxes) {
    if (each.depth > some.whole_to) farthest = std::max(farthest, (each.box.center - places[0]).norm());
  }
  for (const ReplayBox& each : all.boxes) {
    if (each.depth <= some.whole_to) continue;
    mean += (each.box.center - places[0]).norm();
    ++leaves;
  }
  EXPECT_LT(farthest, mean / static_cast<double>(leaves));
}

/// A block as the blisk, a little one as the tool, three poses with a turn, and names that mean harm.
Replay smallReplay(const std::string& name = "part") {
  const auto tree = [](TriangleMesh mesh) {
    return std::make_shared<const ClusteredOctree>(
        ClusteredOctree::build(std::make_shared<const TriangleMesh>(std::move(mesh))));
  };
  Replay replay;
  replay.command = "grind";
  replay.title = name;
  replay.verdicts = {{"clear", Tone::clear}, {"interference", Tone::interference}};
  replay.counts = {{"interference", 1, Tone::interference}};
  replay.blisk = tree(block(Vec3(5, 10, 15), 2));
  replay.blade_of_triangle.assign(replay.blisk->mesh().triangleCount(), 0);
  for (std::size_t t = 0; t < 4; ++t) replay.blade_of_triangle[t] = 1 + static_cast<int>(t % 2);
  replay.blade_count = 2;
  replay.ground_blade = 1;
  replay.parts = {{name, tree(block(Vec3(1, 1, 1), 1))}};
  replay.charts = {{.title = "clearance", .unit = "mm", .linear_within = 0.1, .limits = {{0.5, "near"}}}};
  ReplayTrack track{.name = "path"};
  for (int p = 0; p < 3; ++p) {
    ReplayPose pose;
    pose.tool_in_blisk.translation = Vec3(1.5 * p, -2.0, 40.0);
    // A half turn and more: the quaternions' signs must be chosen.
    pose.tool_in_blisk.rotation = Eigen::AngleAxisd(2.5 * p, Vec3::UnitZ()).toRotationMatrix();
    if (p == 1) {
      pose.verdict = 1;
      pose.contacts = {{1, 0, 2, Vec3(1, 2, 3), Vec3(0, 0, -1), 0.25},
                       {0, 0, 0, Vec3(4, 5, 6), Vec3(1, 0, 0), -0.5}};
      pose.worst = ReplayNearest{0, 2, 0.25, "forward"};
    }
    track.poses.push_back(pose);
  }
  track.series = {{.name = "clearance", .unit = "mm", .values = {1.0, 0.0, std::nan("")}}};
  track.findings = {{.at = 1.0, .verdict = 1, .part = 0, .blade = 2, .side = "forward", .value = 0.25},
                    {.at = 1.5, .verdict = 1, .move_to = 2}};
  replay.tracks = {track};
  return replay;
}

std::string decoded(const std::string& base64_text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : base64_text) {
    if (c == '=') break;
    group = group << 6 | static_cast<std::uint32_t>(kDigits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 0xff);
  }
  return bytes;
}

template <typename Number>
std::vector<Number> numbersOf(const std::string& bytes) {
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

TEST(Base64, isRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(decoded(base64(std::string("\xff\x00\x7f", 3))), std::string("\xff\x00\x7f", 3));
}

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

  // The mesh in 16-bit steps: to half a step.
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
              StartsWith("</script><script>alert(1)</script><!-- "));  // as it was, but for what is no UTF-8

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
  replay.blisk = std::make_shared<const ClusteredOctree>(
      ClusteredOctree::build(std::make_shared<const TriangleMesh>(makeDefaultBlisk(10'000).mesh)));
  replay.blade_of_triangle.assign(replay.blisk->mesh().triangleCount(), 0);
  EXPECT_TRUE(nlohmann::json::parse(replayJson(replay, replayMeshesOf(replay)))["notes"].empty());
  const ReplayMeshes meshes = replayMeshesOf(replay, {.blisk = 2'000, .part = 100});
  const ReplayLimits limits{.boxes = 500, .contacts = 3};
  const auto run = nlohmann::json::parse(replayJson(replay, meshes, limits));
  ASSERT_EQ(run["notes"].size(), 2u);
  EXPECT_THAT(run["notes"][0].get<std::string>(), HasSubstr("Thinned for display only: the blisk"));
  EXPECT_THAT(run["notes"][1].get<std::string>(), HasSubstr("Cluster boxes below level"));
  EXPECT_LE(decoded(run["blisk"]["mesh"]["triangles"]).size(), 2'000u * 12);
  EXPECT_LE(decoded(run["boxes"]["depths"]).size(), 500u);

  replay.tracks[0].poses[1].contacts.resize(10, replay.tracks[0].poses[1].contacts[1]);
  const auto fewer = nlohmann::json::parse(replayJson(replay, meshes, limits));
  EXPECT_EQ(fewer["notes"].size(), 3u);
  // The one contact that is left is the worst.
  EXPECT_EQ(numbersOf<std::uint8_t>(decoded(fewer["tracks"][0]["contacts"]["verdict"])),
            std::vector<std::uint8_t>{1});
}

/// A binary glTF file taken apart.
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
    double dot = 0.0;  // the shorter way round
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

float bigEndianFloat(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) word = word << 8 | static_cast<unsigned char>(bytes[at + k]);
  return std::bit_cast<float>(word);
}

TEST(VtkFile, holdsContactsAndPath) {
  const Replay replay = smallReplay("a part\nof two lines");
  const std::string contacts = contactsVtk(replay);
  EXPECT_THAT(contacts, StartsWith("# vtk DataFile Version 3.0\noctoblisk contacts, mm; verdict: 0 clear, 1 "
                                   "interference; part: 0 a part?of two lines\nBINARY\nDATASET POLYDATA\n"
                                   "POINTS 2 float\n"));
  const std::string head = "POINTS 2 float\n";
  const std::size_t first = contacts.find(head) + head.size();
  EXPECT_EQ(bigEndianFloat(contacts, first + 4), 2.0f);
  EXPECT_EQ(bigEndianFloat(contacts, first + 20), 6.0f);
  EXPECT_THAT(contacts, HasSubstr("\nVERTICES 2 4\n"));
  const std::string depth = "SCALARS depth_mm float 1\nLOOKUP_TABLE default\n";
  EXPECT_EQ(bigEndianFloat(contacts, contacts.find(depth) + depth.size()), 0.25f);
  const std::string path = pathVtk(replay);
  EXPECT_THAT(path, HasSubstr("\nLINES 1 4\n"));
  const std::string clearance = "SCALARS clearance_mm float 1\nLOOKUP_TABLE default\n";
  EXPECT_EQ(bigEndianFloat(path, path.find(clearance) + clearance.size()), 1.0f);
  EXPECT_TRUE(std::isnan(bigEndianFloat(path, path.find(clearance) + clearance.size() + 8)));
}

TEST(VtkFile, tellsUnitsInWords) {
  Replay replay = smallReplay("part");
  replay.verdicts.front().name = "free over 30°";
  replay.tracks.front().series.front().name = "tilt, after";
  replay.tracks.front().series.front().unit = "°";
  const std::string path = pathVtk(replay);
  EXPECT_THAT(path, HasSubstr("verdict: 0 free over 30 degrees, 1 "));
  EXPECT_THAT(path, HasSubstr("\nSCALARS tilt_after_degrees float 1\n"));
}

}  // namespace
}  // namespace octoblisk::demos
