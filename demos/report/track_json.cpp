#include "report/track_json.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/base64.h"

namespace octoblisk::demos {
namespace {

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

}  // namespace

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

}  // namespace octoblisk::demos
