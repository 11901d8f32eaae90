#include "report/replay_json.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/base64.h"
#include "report/replay_boxes.h"

namespace octoblisk::demos {
namespace {

using PageJson = nlohmann::ordered_json;

const char* nameOf(Tone tone) {
  switch (tone) {
    case Tone::clear:
      return "clear";
    case Tone::intended:
      return "intended";
    case Tone::near:
      return "near";
    case Tone::interference:
      return "interference";
    case Tone::open:
      return "open";
  }
  return "";
}

/// A value between two others as a 16-bit fraction.
std::uint16_t stepOf(double value, double low, double high) {
  if (!(high > low)) return 0;
  return static_cast<std::uint16_t>(
      std::lround(std::clamp((value - low) / (high - low), 0.0, 1.0) * 65535.0));
}

PageJson boxJson(const Aabb& box) {
  return {box.min.x(), box.min.y(), box.min.z(), box.max.x(), box.max.y(), box.max.z()};
}

PageJson meshJson(const DisplayMesh& mesh) {
  Aabb box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  std::vector<std::uint16_t> steps;
  steps.reserve(3 * mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) steps.push_back(stepOf(vertex[axis], box.min[axis], box.max[axis]));
  }
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return {{"box", boxJson(box)}, {"vertices", base64Of(steps)}, {"triangles", base64Of(corners)}};
}

PageJson sideJson(const ReplaySide& side) {
  Aabb box;
  for (const Vec3& corner : side.corners) box.extend(corner);
  std::vector<std::uint16_t> steps;
  for (const Vec3& corner : side.corners) {
    for (int axis = 0; axis < 3; ++axis) steps.push_back(stepOf(corner[axis], box.min[axis], box.max[axis]));
  }
  PageJson colors = PageJson::array();
  for (const auto& [color, name] : side.colors) colors.push_back({{"color", color}, {"name", name}});
  PageJson shares = PageJson::array();
  for (const ReplayShare& share : side.shares) {
    shares.push_back({{"name", share.name}, {"percent", share.percent}, {"tone", nameOf(share.tone)}});
  }
  return {{"name", side.name},
          {"region", side.region},
          {"shares", shares},
          {"columns", side.columns},
          {"box", boxJson(box)},
          {"vertices", base64Of(steps)},
          {"color_of_cell", base64Of(side.color_of_cell)},
          {"colors", colors}};
}

/// Places of interest in the replay, a few hundred at most.
std::vector<Vec3> placesOf(const Replay& replay) {
  constexpr std::size_t kMaxPlaces = 256;
  std::vector<Vec3> places;
  for (const ReplayTrack& track : replay.tracks) {
    for (const ReplayPose& pose : track.poses) {
      if (!pose.contacts.empty()) places.push_back(pose.contacts.front().point);
    }
  }
  if (places.empty()) {
    for (const ReplayPose& pose : replay.tracks.front().poses)
      places.push_back(pose.tool_in_blisk.translation);
  }
  const std::size_t stride = (places.size() + kMaxPlaces - 1) / kMaxPlaces;
  std::vector<Vec3> some;
  for (std::size_t i = 0; i < places.size(); i += stride) some.push_back(places[i]);
  return some;
}

PageJson boxesJson(const ReplayBoxes& found) {
  Aabb around;
  double half = 0.0;
  for (const ReplayBox& each : found.boxes) {
    around.extend(each.box.center);
    half = std::max(half, each.box.half_extents.maxCoeff());
  }
  std::vector<std::uint8_t> depths;
  std::vector<std::uint16_t> places;
  for (const auto& [box, depth, is_leaf] : found.boxes) {
    constexpr int kLeafBit = 128;
    depths.push_back(static_cast<std::uint8_t>(depth | (is_leaf ? kLeafBit : 0)));
    for (int axis = 0; axis < 3; ++axis)
      places.push_back(stepOf(box.center[axis], around.min[axis], around.max[axis]));
    for (const double extent : box.half_extents) places.push_back(stepOf(extent, 0.0, half));
    const Eigen::Quaterniond turn(box.axes);
    for (const double value : turn.coeffs()) {  // x, y, z, w
      places.push_back(static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(32767.0 * value))));
    }
  }
  return {{"depths", base64Of(depths)}, {"places", base64Of(places)},
          {"box", boxJson(around)},     {"half", half},
          {"whole", found.whole_to},    {"deepest", found.deepest}};
}

std::string withThousands(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string thinningNote(const std::string& of, const DisplayMesh& drawn, const TriangleMesh& mesh) {
  std::ostringstream text;
  text.precision(2);
  text << "Simplified for display: " << of << " is drawn with " << withThousands(drawn.triangles.size())
       << " instead of " << withThousands(mesh.triangleCount())
       << " triangles, with an error of at most about " << drawn.error
       << " mm. All numbers come from the full mesh.";
  return text.str();
}

/// The meshes, and a note for each simplified one.
void addMeshes(const Replay& replay, const ReplayMeshes& meshes, PageJson& run,
               std::vector<std::string>& notes) {
  const auto noteThinned = [&](const std::string& of, const DisplayMesh& drawn, const TriangleMesh& whole) {
    if (drawn.is_simplified) notes.push_back(thinningNote(of, drawn, whole));
  };
  noteThinned("the blisk", meshes.blisk, replay.blisk->mesh());
  PageJson groups = PageJson::array();
  for (const DisplayMesh::Group& group : meshes.blisk.groups) {
    groups.push_back({group.number, group.first, group.count});
  }
  run["blisk"] = {{"mesh", meshJson(meshes.blisk)}, {"groups", groups}};
  PageJson parts = PageJson::array();
  for (std::size_t p = 0; p < replay.parts.size(); ++p) {
    const std::string& name = replay.parts[p].name;
    noteThinned(name, meshes.parts[p], replay.parts[p].tree->mesh());
    parts.push_back({{"name", name}, {"color", colorOfPart(name, p)}, {"mesh", meshJson(meshes.parts[p])}});
  }
  run["parts"] = parts;
}

PageJson factsJson(const std::vector<Table>& facts) {
  PageJson tables = PageJson::array();
  for (const Table& table : facts) {
    tables.push_back({{"title", table.caption}, {"columns", table.columns}, {"rows", table.rows}});
  }
  return tables;
}

constexpr std::uint8_t kNoPartByte = 255;

/// An index into kSides of the page (web/src/run.js).
int numberOfSide(const std::string& side) {
  if (side == "forward") return 1;
  if (side == "backward") return 2;
  if (side == "convex") return 3;
  return side == "concave" ? 4 : 0;
}

void append(std::vector<float>& floats, const Vec3& v) {
  for (const double value : v) floats.push_back(static_cast<float>(value));
}

PageJson posesJson(const ReplayTrack& track) {
  std::vector<float> poses;
  for (const ReplayPose& pose : track.poses) {
    append(poses, pose.tool_in_blisk.translation);
    const Eigen::Quaterniond turn(pose.tool_in_blisk.rotation);
    for (const double value : {turn.w(), turn.x(), turn.y(), turn.z()}) {
      poses.push_back(static_cast<float>(value));
    }
  }
  return base64Of(poses);
}

PageJson nearestJson(const ReplayTrack& track) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  std::vector<std::uint8_t> part, side, clearance_part;
  std::vector<std::uint16_t> blade, clearance_blade;
  std::vector<float> depth, clearance;
  const auto add = [&](const std::optional<ReplayNearest>& nearest, auto& parts, auto& blades, auto& values,
                       double sign) {
    parts.push_back(nearest ? static_cast<std::uint8_t>(std::min<std::size_t>(nearest->part, kNoPartByte))
                            : kNoPartByte);
    blades.push_back(nearest ? static_cast<std::uint16_t>(nearest->blade) : std::uint16_t{0});
    values.push_back(nearest ? static_cast<float>(sign * nearest->depth) : kNone);
  };
  for (const ReplayPose& pose : track.poses) {
    add(pose.worst, part, blade, depth, 1.0);
    side.push_back(pose.worst ? static_cast<std::uint8_t>(numberOfSide(pose.worst->side)) : std::uint8_t{0});
    add(pose.clearance, clearance_part, clearance_blade, clearance, -1.0);
  }
  return {{"part", base64Of(part)},
          {"blade", base64Of(blade)},
          {"side", base64Of(side)},
          {"depth", base64Of(depth)},
          {"clearance", base64Of(clearance)},
          {"clearance_part", base64Of(clearance_part)},
          {"clearance_blade", base64Of(clearance_blade)}};
}

/// The drawn contacts of each pose: only the deepest if there are too many.
PageJson contactsJson(const ReplayTrack& track, std::size_t most, std::size_t& left_out) {
  std::size_t total = 0;
  for (const ReplayPose& pose : track.poses) total += pose.contacts.size();
  const std::size_t per_pose = total > most ? std::max<std::size_t>(1, most / track.poses.size())
                                            : std::numeric_limits<std::size_t>::max();
  std::vector<std::uint32_t> first = {0};
  std::vector<std::uint8_t> verdicts;
  std::vector<float> points, normals;
  for (const ReplayPose& pose : track.poses) {
    std::vector<ReplayContact> contacts = pose.contacts;
    if (contacts.size() > per_pose) {
      std::ranges::stable_sort(contacts, [](const ReplayContact& a, const ReplayContact& b) {
        return std::pair(a.verdict, a.depth) > std::pair(b.verdict, b.depth);
      });
      left_out += contacts.size() - per_pose;
      contacts.resize(per_pose);
    }
    for (const ReplayContact& contact : contacts) {
      verdicts.push_back(static_cast<std::uint8_t>(contact.verdict));
      append(points, contact.point);
      append(normals, contact.normal);
    }
    first.push_back(static_cast<std::uint32_t>(verdicts.size()));
  }
  return {{"first", base64Of(first)},
          {"verdict", base64Of(verdicts)},
          {"points", base64Of(points)},
          {"normals", base64Of(normals)}};
}

PageJson findingsJson(const ReplayTrack& track) {
  PageJson rows = PageJson::array();
  for (const ReplayFinding& finding : track.findings) {
    PageJson value;  // null
    if (finding.value) value = *finding.value;
    rows.push_back({finding.at, finding.verdict,
                    finding.part ? static_cast<std::int64_t>(*finding.part) : std::int64_t{-1},
                    finding.blade.value_or(-1), numberOfSide(finding.side), value,
                    finding.motion_to ? static_cast<std::int64_t>(*finding.motion_to) : std::int64_t{-1}});
  }
  return rows;
}

/// If the track has more than `most_contacts`, keeps only the deepest of each pose, and counts those left
/// out. Numbers are in base64 in this machine's byte order.
PageJson trackJson(const ReplayTrack& track, std::size_t most_contacts, std::size_t& contacts_left_out) {
  std::vector<std::uint8_t> verdicts;
  PageJson texts;  // null
  for (const ReplayPose& pose : track.poses) {
    verdicts.push_back(static_cast<std::uint8_t>(pose.verdict));
    if (!pose.text.empty()) texts.push_back(pose.text);
  }
  if (texts.size() != track.poses.size()) texts = nullptr;
  PageJson series = PageJson::array();
  for (const ReplaySeries& each : track.series) {
    std::vector<float> values;
    for (const double value : each.values) values.push_back(static_cast<float>(value));
    series.push_back({{"chart", each.chart},
                      {"name", each.name},
                      {"unit", each.unit},
                      {"in_status", each.in_status},
                      {"values", base64Of(values)}});
  }
  return {{"name", track.name},
          {"poses", posesJson(track)},
          {"verdict", base64Of(verdicts)},
          {"texts", texts},
          {"nearest", nearestJson(track)},
          {"series", series},
          {"contacts", contactsJson(track, most_contacts, contacts_left_out)},
          {"findings", findingsJson(track)}};
}

}  // namespace

std::string replayJson(const Replay& replay, const ReplayMeshes& meshes, const ReplayLimits& limits) {
  PageJson verdicts = PageJson::array(), counts = PageJson::array(), charts = PageJson::array(),
           tracks = PageJson::array();
  for (const ReplayVerdict& verdict : replay.verdicts) {
    verdicts.push_back({{"name", verdict.name}, {"tone", nameOf(verdict.tone)}});
  }
  for (const ReplayCount& count : replay.counts) {
    counts.push_back({{"name", count.name}, {"count", count.count}, {"tone", nameOf(count.tone)}});
  }
  for (const ReplayChart& chart : replay.charts) {
    PageJson lines = PageJson::array();
    for (const auto& [value, name] : chart.limits) lines.push_back({{"value", value}, {"name", name}});
    charts.push_back(
        {{"title", chart.title}, {"unit", chart.unit}, {"stretch", chart.linear_within}, {"limits", lines}});
  }
  std::vector<std::string> notes = replay.notes;
  std::size_t left_out = 0;
  for (const ReplayTrack& track : replay.tracks) {
    tracks.push_back(trackJson(track, limits.contacts, left_out));
  }
  if (left_out > 0) {
    notes.push_back("The picture omits " + withThousands(left_out) +
                    " contacts, the shallowest of each pose; contacts.csv has them.");
  }
  PageJson obstacles = PageJson::array();
  for (const Fixture& fixture : replay.fixtures) obstacles.push_back(fixture.name);
  PageJson run = {{"format", 1},
                  {"command", replay.command},
                  {"title", replay.title},
                  {"subtitle", replay.subtitle},
                  {"step", {{"one", replay.one}, {"many", replay.many}}},
                  {"findings",
                   {{"title", replay.findings_title},
                    {"where", replay.one == "pose" ? "Where" : "Point"},
                    {"value", replay.findings_value},
                    {"none", replay.no_findings}}},
                  {"verdicts", verdicts},
                  {"counts", counts},
                  {"blade_count", replay.blade_count},
                  {"ground_blade", replay.ground_blade},
                  {"obstacles", obstacles},
                  {"start", {{"track", replay.start_track}, {"at", replay.start_at}}},
                  {"everywhere", replay.contacts_of_all_poses},
                  {"charts", charts},
                  {"tracks", tracks}};
  addMeshes(replay, meshes, run, notes);
  const ReplayBoxes boxes = replayBoxesOf(*replay.blisk, placesOf(replay), limits.boxes);
  if (boxes.whole_to < boxes.deepest) {
    notes.push_back("Cluster boxes below level " + std::to_string(boxes.whole_to) +
                    " are shown only near the touches: the tree has " +
                    withThousands(replay.blisk->stats().leaves) + " leaves.");
  }
  if (replay.side) run["side"] = sideJson(*replay.side);
  run["boxes"] = boxesJson(boxes);
  run["facts"] = factsJson(replay.facts);
  run["notes"] = notes;

  const std::string text = run.dump(-1, ' ', false, PageJson::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace octoblisk::demos
