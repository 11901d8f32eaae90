#include "access/access_replay.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "access/access_summary.h"
#include "report/versions.h"

namespace octoblisk::demos {
namespace {

constexpr double kNarrow = 30.0;  // degrees

// Indices into accessVerdicts().
enum AccessVerdict : std::size_t { kFreeWidely, kFreeNarrowly, kFreeAtOneTilt, kNowhereFree };

std::vector<ReplayVerdict> accessVerdicts() {
  return {{"free over more than 30°", Tone::intended},
          {"free over 30° or less", Tone::near},
          {"free at one tilt", Tone::near},
          {"nowhere free", Tone::interference}};
}

double widestRange(const SiteAccess& access) {
  return access.widest ? access.ranges[*access.widest].width() : 0.0;
}

AccessVerdict accessVerdictOf(const SiteAccess& access) {
  if (!access.widest) return kNowhereFree;
  if (widestRange(access) == 0.0) return kFreeAtOneTilt;
  return widestRange(access) > kNarrow ? kFreeWidely : kFreeNarrowly;
}

std::string degreesText(double value) {
  std::ostringstream text;
  text << value << "°";
  return text.str();
}

/// The free range of a site, and its most frequent obstacle.
std::string siteText(const AccessMap& map, const SiteAccess& access) {
  std::string text;
  if (access.widest) {
    const FreeRange& range = access.ranges[*access.widest];
    const std::string lead = " at lead " + degreesText(map.question.options.leads[range.lead]);
    text = range.width() == 0.0 ? "tilt " + degreesText(range.tilt_from) + " alone" + lead
                                : "tilt " + degreesText(range.tilt_from) + " to " +
                                      degreesText(range.tilt_to) + lead + ", shown at their middle";
  }
  if (!access.obstacles.empty()) {
    text += (text.empty() ? "most frequent obstacle: " : "; otherwise most frequent obstacle: ") +
            describe(access.obstacles.front().obstacle, map.parts, BodyNames(map.blade_count, map.fixtures));
  }
  return text;
}

Pose poseShown(const AccessMap& map, const ContactSite& site, const SiteAccess& access) {
  if (!access.widest) return site.base;
  const FreeRange& range = access.ranges[*access.widest];
  return tiltedPose(site, 0.5 * (range.tilt_from + range.tilt_to), map.question.options.leads[range.lead]);
}

ReplayTrack accessTrack(const AccessMap& map) {
  ReplayTrack track{.name = "points"};
  ReplaySeries widest{.name = "widest free range of tilt", .unit = "degrees"};
  const double asked = static_cast<double>(map.question.options.leads.size()) * map.question.options.tilts;
  ReplaySeries share{.name = "free fraction of all tilts and leads", .unit = "%"};
  share.chart = 1;
  for (std::size_t s = 0; s < map.sites.size(); ++s) {
    const ContactSite& site = map.sites[s];
    const SiteAccess& access = map.access[s];
    const AccessVerdict verdict = accessVerdictOf(access);
    ReplayPose pose;
    pose.tool_in_blisk = poseShown(map, site, access);
    pose.verdict = verdict;
    pose.contacts.push_back({verdict, map.question.rules.grinding_part, map.question.rules.ground_blade,
                             site.point, Vec3(-site.normal), 0.0});
    pose.text = siteText(map, access);
    if (pose.text.empty()) pose.text = "no obstacle at any tilt";
    track.poses.push_back(std::move(pose));
    widest.values.push_back(widestRange(access));
    share.values.push_back(100.0 * static_cast<double>(access.free) / asked);
    if (verdict == kFreeWidely) continue;
    ReplayFinding finding{.at = static_cast<double>(s), .verdict = verdict, .value = widestRange(access)};
    if (!access.obstacles.empty()) {
      finding.part = access.obstacles.front().obstacle.part;
      finding.blade = access.obstacles.front().obstacle.blade;
    }
    track.findings.push_back(std::move(finding));
  }
  track.series = {std::move(widest), std::move(share)};
  return track;
}

std::vector<Table> accessFacts(const AccessMap& map, const ClusteredOctree& blisk,
                               const std::string& blisk_name) {
  std::ostringstream depth, margin, free;
  depth << map.question.rules.max_depth << " mm";
  margin << map.question.rules.near_miss << " mm";
  free << std::round(1000.0 * map.freeFraction()) / 10.0 << " %";
  Table parts{.name = "parts", .caption = "Parts of the tool", .columns = {"Part", "Triangles"}};
  for (const ToolPart& part : map.parts) {
    parts.rows.push_back({part.name, std::to_string(part.tree->mesh().triangleCount())});
  }
  const AccessOptions& options = map.question.options;
  return {
      parts,
      {.name = "limits",
       .caption = "Limits and tolerances",
       .rows = {{"Ground blade", std::to_string(map.question.rules.ground_blade)},
                {"Greatest depth of the belt in it", depth.str()},
                {"Margin of all other pairs", margin.str()},
                {"Tilts", degreesText(options.tilt_from) + " to " +
                              degreesText(options.tilt(options.tilts - 1)) + ", every " +
                              degreesText(options.tilt_step)},
                {"Leads", degreesText(options.leads.front()) + " to " + degreesText(options.leads.back()) +
                              ", " + std::to_string(options.leads.size())},
                {"Free fraction of all of these", free.str()}}},
      {.name = "input",
       .caption = "Input",
       .rows = {{"Blisk", blisk_name},
                {"Triangles of the blisk", std::to_string(blisk.stats().triangles)},
                {"Points", map.question.of_path ? "poses of a path" : "a grid on a blade's side"}}},
      versionsTable()};
}

}  // namespace

std::size_t AccessMap::nowhereFree() const {
  return static_cast<std::size_t>(std::ranges::count(access, 0u, &SiteAccess::free));
}

double AccessMap::freeFraction() const {
  std::size_t free = 0;
  for (const SiteAccess& site : access) free += site.free;
  return static_cast<double>(free) / static_cast<double>(question.poses() * access.size());
}

Replay accessReplay(const AccessMap& map, std::shared_ptr<const ClusteredOctree> blisk,
                    const BladesFound& blades, const std::string& blisk_name) {
  Replay replay;
  const std::size_t none = map.nowhereFree(), points = map.sites.size();
  replay.command = "access";
  replay.title =
      none == 0 ? "All " + std::to_string(points) + " points can be reached"
                : "No free pose at " + std::to_string(none) + " of " + std::to_string(points) + " points";
  replay.subtitle = "Orientations in which the belt grinder reaches the points of blade " +
                    std::to_string(map.question.rules.ground_blade) + " of " + std::to_string(blades.count);
  replay.one = "point";
  replay.many = "points";
  replay.findings_title = "Points with few free orientations";
  replay.findings_value = "Widest, °";
  replay.no_findings = "Every point is free over more than 30° of tilt.";
  replay.verdicts = accessVerdicts();
  for (std::size_t v = 0; v < replay.verdicts.size(); ++v) {
    const auto count =
        std::ranges::count_if(map.access, [&](const SiteAccess& a) { return accessVerdictOf(a) == v; });
    replay.counts.push_back(
        {replay.verdicts[v].name, static_cast<std::size_t>(count), replay.verdicts[v].tone});
  }
  replay.blade_of_triangle = blades.blade_of_triangle;
  replay.blade_count = blades.count;
  replay.fixtures = map.fixtures;
  replay.ground_blade = map.question.rules.ground_blade;
  replay.parts = map.parts;
  replay.charts = {
      {.title = "Widest free range of tilt at each point", .unit = "degrees", .limits = {{kNarrow, "30°"}}},
      {.title = "Free fraction of tilts and leads at each point", .unit = "%"}};
  replay.tracks.push_back(accessTrack(map));
  replay.contacts_of_all_poses = true;
  const std::vector<ReplayFinding>& findings = replay.tracks.front().findings;
  const auto nowhere = std::ranges::find(findings, std::size_t{kNowhereFree}, &ReplayFinding::verdict);
  if (nowhere != findings.end()) replay.start_at = nowhere->at;
  replay.facts = accessFacts(map, *blisk, blisk_name);
  replay.notes.push_back(
      "At each point the tool is shown at the middle of its widest free range of tilt; if no orientation is "
      "free, at tilt 0 and lead 0. Points are counted from 0.");
  replay.blisk = std::move(blisk);
  return replay;
}

}  // namespace octoblisk::demos
