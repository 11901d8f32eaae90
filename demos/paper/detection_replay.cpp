#include "paper/detection_replay.h"

#include <algorithm>
#include <map>

#include "io/number_text.h"
#include "octoblisk/contacts.h"
#include "octoblisk/distance.h"
#include "report/versions.h"

namespace octoblisk::demos {
namespace {

// Indices into detectionVerdicts().
enum DetectionVerdict : std::size_t { kVerdictFound, kVerdictClear, kVerdictFalseAlarm, kVerdictMissed };

std::vector<ReplayVerdict> detectionVerdicts() {
  return {{"touching, called colliding", Tone::intended},
          {"clear, called clear", Tone::clear},
          {"false alarm", Tone::interference},
          {"missed", Tone::interference}};
}

DetectionVerdict verdictOf(const BeltPose& pose, const PoseDetection& called) {
  if (pose.touches) return called.colliding ? kVerdictFound : kVerdictMissed;
  return called.colliding ? kVerdictFalseAlarm : kVerdictClear;
}

/// The deepest touching triangle pair of each blade.
std::map<int, Contact> deepestOfBlades(const DetectionScene& scene, const Pose& belt_in_blisk,
                                       std::vector<Contact>& found) {
  contacts(*scene.blisk, *scene.belt, belt_in_blisk, 0.0, found);
  std::map<int, Contact> deepest;
  for (const Contact& contact : found) {
    const int blade = scene.model.blades.blade_of_triangle[contact.triangle_a];
    const auto [at, is_first] = deepest.try_emplace(blade, contact);
    if (!is_first && contact.distance < at->second.distance) at->second = contact;
  }
  return deepest;
}

constexpr double kCubicCentimetre = 1e3;  // mm³

/// The results at each pose of one of the two paths.
struct Called {
  const std::vector<PoseDetection>&improved, &ours;
};

ReplayTrack detectionTrack(const DetectionScene& scene, const std::string& name,
                           const std::vector<BeltPose>& path, const Called& called) {
  ReplayTrack track{.name = name};
  ReplaySeries clearance{.name = "clearance of the belt", .unit = "mm"};
  ReplaySeries improved{.chart = 1, .name = "paper's improved octrees", .unit = "cm³"};
  ReplaySeries ours{.chart = 1, .name = "our boxes", .unit = "cm³"};
  std::vector<Contact> found;
  TrianglePair last;
  for (std::size_t p = 0; p < path.size(); ++p) {
    const Clearance apart = distance(*scene.blisk, *scene.belt, path[p].belt_in_mesh, {.hint = last});
    last = apart.triangles();
    const int nearest = scene.model.blades.blade_of_triangle[apart.triangle_a];
    const DetectionVerdict verdict = verdictOf(path[p], called.improved[p]);
    ReplayPose pose{.tool_in_blisk = path[p].belt_in_mesh, .verdict = verdict};
    if (path[p].touches) {
      for (const auto& [blade, contact] : deepestOfBlades(scene, path[p].belt_in_mesh, found))
        pose.contacts.push_back({verdict, 0, blade, contact.point_on_a, contact.normal, -contact.distance});
      pose.text = "the belt touches ";
    } else {
      pose.text = "the belt is " + fixedText(apart.distance, 3) + " mm from ";
    }
    const double left = called.improved[p].volume_left / kCubicCentimetre;
    pose.text += nearest == 0 ? std::string("the hub") : "blade " + std::to_string(nearest);
    pose.text += "; the boxes leave " + fixedText(left, 2) + " cm³ to examine";
    track.poses.push_back(std::move(pose));
    clearance.values.push_back(apart.distance);
    improved.values.push_back(left);
    ours.values.push_back(called.ours[p].volume_left / kCubicCentimetre);
    if (verdict != kVerdictFalseAlarm && verdict != kVerdictMissed) continue;
    track.findings.push_back({.at = static_cast<double>(p),
                              .verdict = verdict,
                              .part = 0,
                              .blade = nearest,
                              .value = apart.distance});
  }
  track.series = {std::move(clearance), std::move(improved), std::move(ours)};
  return track;
}

std::vector<Table> detectionFacts(const DetectionScene& scene, const DetectionResult& result) {
  return {{.name = "parts",
           .caption = "Parts",
           .columns = {"Part", "Triangles"},
           .rows = {{scene.model.name, std::to_string(scene.blisk->stats().triangles)},
                    {"belt", std::to_string(scene.belt->stats().triangles)}}},
          {.name = "limits",
           .caption = "Limits and tolerances",
           .rows = {{"Method", result.rows[kImproved].method},
                    {"Points", std::to_string(result.cloud_points)},
                    {"FNOP, greatest number of points in a leaf", std::to_string(result.options.fnop)},
                    {"Clusters of each part", std::to_string(result.options.k_means.k)},
                    {"Lift off the blade", fixedText(scene.lift, 0) + " mm"},
                    {"Touch", "exact on the triangles"}}},
          versionsTable()};
}

}  // namespace

Replay detectionReplay(const DetectionScene& scene, const DetectionResult& result) {
  Replay replay;
  const DetectionRow &improved = result.rows[kImproved], &ours = result.rows[kOursBothBoxes];
  const Alarms& lifted = improved.lifted;
  replay.command = "paper table3";
  replay.title =
      partText(lifted.false_positives, lifted.clear) + " clear poses near a blade are false alarms";
  replay.subtitle =
      "Verdicts of the paper's improved octrees, compared with the triangles, along the path lifted " +
      fixedText(scene.lift, 0) + " mm off the blade, and along the ground path";
  replay.findings_title = "Poses with a wrong verdict";
  replay.findings_value = "Clearance, mm";
  replay.no_findings = "Every verdict is right.";
  replay.verdicts = detectionVerdicts();
  replay.blisk = scene.blisk;
  replay.blade_of_triangle = scene.model.blades.blade_of_triangle;
  replay.blade_count = scene.model.blades.count;
  replay.parts = {{.name = "belt", .tree = scene.belt}};
  replay.charts = {{.title = "Clearance of the belt over the path", .unit = "mm", .linear_within = 1.0},
                   {.title = "Volume left to examine", .unit = "cm³"}};
  replay.tracks = {detectionTrack(scene, "lifted", scene.lifted, {improved.at_lifted, ours.at_lifted}),
                   detectionTrack(scene, "ground", scene.ground, {improved.at_ground, ours.at_ground})};
  for (std::size_t v = 0; v < replay.verdicts.size(); ++v) {
    const auto count = std::ranges::count(replay.tracks.front().poses, v, &ReplayPose::verdict);
    replay.counts.push_back(
        {replay.verdicts[v].name, static_cast<std::size_t>(count), replay.verdicts[v].tone});
  }
  const std::vector<ReplayFinding>& findings = replay.tracks.front().findings;
  if (!findings.empty()) replay.start_at = findings.front().at;
  replay.facts = detectionFacts(scene, result);
  replay.notes = {
      "The counts above are for the lifted path; \"Path\" below the picture switches to the ground path. The "
      "boxes in the picture are those of our own tree."};
  return replay;
}

}  // namespace octoblisk::demos
