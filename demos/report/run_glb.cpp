#include "report/run_glb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <vector>

#include "io/new_file.h"

namespace octoblisk::demos {
namespace {

using GltfJson = nlohmann::ordered_json;

constexpr double kMarkRadius = 0.3;  // mm

// glTF's codes of number types and buffers.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kChunkJson = 0x4E4F534A, kChunkBinary = 0x004E4942, kGlbMagic = 0x46546C67;

void appendWord(std::string& bytes, std::size_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xff);
}

/// glTF's document and its buffer, built together.
class GltfFile {
 public:
  /// `floats` as vectors of `width` (1: SCALAR, 3: VEC3, 4: VEC4), with their bounds if asked for.
  std::size_t addFloats(const std::vector<float>& floats, std::size_t width, bool bounds, bool of_vertices) {
    GltfJson accessor = {{"bufferView", addView(floats, of_vertices ? kArrayBuffer : 0)},
                         {"componentType", kFloat},
                         {"count", floats.size() / width},
                         {"type", width == 1   ? "SCALAR"
                                  : width == 3 ? "VEC3"
                                               : "VEC4"}};
    if (bounds) {
      std::vector<float> low(floats.begin(), floats.begin() + static_cast<std::ptrdiff_t>(width)), high = low;
      for (std::size_t i = 0; i < floats.size(); ++i) {
        low[i % width] = std::min(low[i % width], floats[i]);
        high[i % width] = std::max(high[i % width], floats[i]);
      }
      accessor["min"] = low;
      accessor["max"] = high;
    }
    return add("accessors", std::move(accessor));
  }

  /// Corners of triangles, as accessors that share one view.
  std::size_t addIndexView(const std::vector<std::uint32_t>& indices) {
    return addView(indices, kElementArrayBuffer);
  }
  std::size_t addIndices(std::size_t view, std::size_t first, std::size_t count) {
    return add("accessors", {{"bufferView", view},
                             {"byteOffset", first * sizeof(std::uint32_t)},
                             {"componentType", kUnsignedInt},
                             {"count", count},
                             {"type", "SCALAR"}});
  }

  /// Appends to an array of the document and returns the index there.
  std::size_t add(const std::string& array, GltfJson element) {
    document_[array].push_back(std::move(element));
    return document_[array].size() - 1;
  }

  GltfJson& document() { return document_; }

  std::string bytes() {
    add("buffers", {{"byteLength", buffer_.size()}});
    std::string json = document_.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
    json.append((4 - json.size() % 4) % 4, ' ');
    std::string file;
    appendWord(file, kGlbMagic);
    appendWord(file, 2);
    appendWord(file, 12 + 8 + json.size() + 8 + buffer_.size());
    appendWord(file, json.size());
    appendWord(file, kChunkJson);
    file += json;
    appendWord(file, buffer_.size());
    appendWord(file, kChunkBinary);
    return file + buffer_;
  }

 private:
  /// All numbers have four bytes, so every view is aligned.
  template <typename Number>
  std::size_t addView(const std::vector<Number>& numbers, int target) {
    static_assert(sizeof(Number) == 4);
    GltfJson view = {
        {"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", numbers.size() * sizeof(Number)}};
    if (target != 0) view["target"] = target;
    buffer_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
    return add("bufferViews", std::move(view));
  }

  GltfJson document_ = {{"asset", {{"version", "2.0"}, {"generator", "octoblisk"}}}};
  std::string buffer_;
};

/// glTF's colours are linear.
GltfJson linearColor(const std::string& hex) {
  GltfJson color = GltfJson::array();
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = std::stoi(hex.substr(1 + 2 * k, 2), nullptr, 16) / 255.0;
    color.push_back(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
  color.push_back(1.0);
  return color;
}

std::size_t addMaterial(GltfFile& file, const std::string& name, const std::string& hex) {
  return file.add(
      "materials",
      {{"name", name},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", linearColor(hex)}, {"metallicFactor", 0.1}, {"roughnessFactor", 0.6}}},
       {"doubleSided", true}});
}

/// A mesh with one primitive per group, in the group's material.
template <typename MaterialOf>
std::size_t addDisplayMesh(GltfFile& file, const std::string& name, const DisplayMesh& mesh,
                           MaterialOf&& material_of) {
  std::vector<float> positions;
  for (const Vec3& vertex : mesh.vertices) {
    for (const double value : vertex) positions.push_back(static_cast<float>(value));
  }
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : mesh.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  const std::size_t position = file.addFloats(positions, 3, true, true);
  const std::size_t view = file.addIndexView(corners);
  GltfJson primitives = GltfJson::array();
  for (const auto& [number, first, count] : mesh.groups) {
    primitives.push_back({{"attributes", {{"POSITION", position}}},
                          {"indices", file.addIndices(view, 3 * first, 3 * count)},
                          {"material", material_of(number)}});
  }
  return file.add("meshes", {{"name", name}, {"primitives", primitives}});
}

std::size_t addBliskNode(GltfFile& file, const Replay& replay, const DisplayMesh& drawn) {
  const std::size_t hub = addMaterial(file, "hub or shroud", "#aeb7c2");
  const std::array blades = {addMaterial(file, "blades, even", "#c3ccd6"),
                             addMaterial(file, "blades, odd", "#94a6ba")};
  std::size_t ground = hub;
  if (replay.ground_blade != 0) ground = addMaterial(file, "ground blade", "#e3a9c4");
  std::size_t fixture = hub;
  if (!replay.fixtures.empty()) fixture = addMaterial(file, "obstacles", "#a08c72");
  const BodyNames names(replay.blade_count, replay.fixtures);
  const std::size_t mesh = addDisplayMesh(file, "blisk", drawn, [&](int blade) {
    if (blade == 0) return hub;
    if (names.isFixture(blade)) return fixture;
    return blade == replay.ground_blade ? ground : blades[static_cast<std::size_t>(blade % 2)];
  });
  GltfJson node = {{"name", "blisk"}, {"mesh", mesh}};
  if (drawn.is_simplified) {
    node["extras"] = {{"triangles", replay.blisk->mesh().triangleCount()},
                      {"thinned_to", drawn.triangles.size()},
                      {"error_mm", drawn.error}};
  }
  return file.add("nodes", std::move(node));
}

std::size_t addToolNode(GltfFile& file, const Replay& replay, std::span<const DisplayMesh> drawn) {
  GltfJson children = GltfJson::array();
  for (std::size_t p = 0; p < replay.parts.size(); ++p) {
    const std::string& name = replay.parts[p].name;
    const std::size_t material = addMaterial(file, name, colorOfPart(name, p));
    const std::size_t mesh = addDisplayMesh(file, name, drawn[p], [&](int) { return material; });
    children.push_back(file.add("nodes", {{"name", name}, {"mesh", mesh}}));
  }
  return file.add("nodes", {{"name", "tool"}, {"children", children}});
}

/// Straight from pose to pose, turning the shorter way.
void addAnimation(GltfFile& file, const ReplayTrack& track, std::size_t node, double poses_per_second) {
  std::vector<float> times, places, turns;
  Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
  for (std::size_t p = 0; p < track.poses.size(); ++p) {
    const Pose& pose = track.poses[p].tool_in_blisk;
    times.push_back(static_cast<float>(static_cast<double>(p) / poses_per_second));
    for (const double value : pose.translation) places.push_back(static_cast<float>(value));
    Eigen::Quaterniond turn(pose.rotation);
    turn.normalize();
    if (turn.dot(before) < 0.0) turn.coeffs() *= -1.0;
    for (const double value : turn.coeffs()) turns.push_back(static_cast<float>(value));  // x, y, z, w
    before = turn;
  }
  const std::size_t input = file.addFloats(times, 1, true, false);
  GltfJson channels = GltfJson::array(), samplers = GltfJson::array();
  const auto add = [&](const char* path, std::size_t output) {
    channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers.push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
  };
  add("translation", file.addFloats(places, 3, false, false));
  add("rotation", file.addFloats(turns, 4, false, false));
  file.add("animations", {{"name", track.name}, {"channels", channels}, {"samplers", samplers}});
}

/// An octahedron around each point.
DisplayMesh marksAt(std::span<const Vec3> points) {
  DisplayMesh marks;
  for (const Vec3& point : points) {
    const auto first = static_cast<std::uint32_t>(marks.vertices.size());
    for (int k = 0; k < 6; ++k) {  // +x, −x, +y, …
      marks.vertices.push_back(point + (k % 2 == 0 ? kMarkRadius : -kMarkRadius) * Vec3::Unit(k / 2));
    }
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      const std::uint32_t x = octant & 1, y = octant >> 1 & 1, z = octant >> 2;
      TriangleMesh::Indices triangle = {first + x, first + 2 + y, first + 4 + z};
      if ((x + y + z) % 2 == 1) std::swap(triangle[0], triangle[1]);  // outward
      marks.triangles.push_back(triangle);
    }
  }
  marks.groups = {{0, 0, marks.triangles.size()}};
  return marks;
}

void addContactNodes(GltfFile& file, const Replay& replay, std::size_t most, GltfJson& children) {
  for (std::size_t v = 0; v < replay.verdicts.size(); ++v) {
    std::vector<Vec3> points;
    for (const ReplayPose& pose : replay.tracks.front().poses) {
      for (const ReplayContact& contact : pose.contacts) {
        if (contact.verdict == v) points.push_back(contact.point);
      }
    }
    if (points.empty()) continue;
    const std::size_t stride = (points.size() + most - 1) / most;
    std::vector<Vec3> some;
    for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
    constexpr std::array kToneColors = {"#5c6675", "#00694a", "#b87a00", "#c9370c",
                                        "#6b3fa0"};  // one per Tone
    const std::string name = "contacts: " + replay.verdicts[v].name;
    const std::size_t material =
        addMaterial(file, name, kToneColors[static_cast<std::size_t>(replay.verdicts[v].tone)]);
    const std::size_t mesh = addDisplayMesh(file, name, marksAt(some), [&](int) { return material; });
    children.push_back(file.add("nodes", {{"name", name}, {"mesh", mesh}}));
  }
}

}  // namespace

std::string glbOf(const Replay& replay, const ReplayMeshes& meshes, const GlbOptions& options) {
  if (!(options.poses_per_second > 0.0)) throw std::invalid_argument("glbOf: the rate must be above 0");
  GltfFile file;
  GltfJson children = GltfJson::array();
  children.push_back(addBliskNode(file, replay, meshes.blisk));
  const std::size_t tool = addToolNode(file, replay, meshes.parts);
  children.push_back(tool);
  for (const ReplayTrack& track : replay.tracks) addAnimation(file, track, tool, options.poses_per_second);
  addContactNodes(file, replay, std::max<std::size_t>(1, options.contacts), children);
  constexpr double kHalf = 0.70710678118654752440;
  const std::size_t root = file.add("nodes", {{"name", "octoblisk " + replay.command},
                                              {"rotation", {-kHalf, 0.0, 0.0, kHalf}},
                                              {"scale", {0.001, 0.001, 0.001}},
                                              {"children", children}});
  file.add("scenes", {{"nodes", GltfJson::array({root})}});
  file.document()["scene"] = 0;
  file.document()["asset"]["extras"] = {{"title", replay.title},
                                        {"poses_per_second", options.poses_per_second}};
  return file.bytes();
}

void writeGlb(const Replay& replay, const ReplayMeshes& meshes, const std::filesystem::path& file,
              const GlbOptions& options) {
  writeFile(file, glbOf(replay, meshes, options));
}

}  // namespace octoblisk::demos
