#include "report/grinding_replay.h"

#include <array>
#include <limits>

#include "grinding/motion_check.h"
#include "io/number_text.h"
#include "report/coverage_report.h"
#include "report/grinding_pictures.h"
#include "report/grinding_report.h"
#include "report/versions.h"

namespace octoblisk::demos {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// An index into Replay::verdicts.
std::size_t verdictOfMotion(MotionReport::Outcome outcome) {
  constexpr std::size_t kAfterPoses = 4;
  switch (outcome) {
    case MotionReport::Outcome::hit:
      return kAfterPoses;
    case MotionReport::Outcome::too_deep:
      return kAfterPoses + 1;
    default:
      return kAfterPoses + 2;
  }
}

std::optional<ReplayNearest> worstOf(const GrindingRun& run, const PoseReport& pose) {
  const Touch* const worst = worstOrNearest(pose);
  if (!worst) return std::nullopt;
  return ReplayNearest{worst->part, worst->blade, worst->depth, run.faceOf(*worst)};
}

ReplayPose replayPoseOf(const GrindingRun& run, const PoseReport& pose) {
  ReplayPose shown;
  shown.tool_in_blisk = pose.tool_in_blisk;
  shown.verdict = static_cast<std::size_t>(pose.verdict);
  for (const Touch& touch : pose.touches) {
    if (touch.is_inside) continue;
    shown.contacts.push_back({static_cast<std::size_t>(touch.verdict), touch.part, touch.blade,
                              touch.contact.point_on_a, touch.contact.normal, 0.0 - touch.contact.distance});
  }
  shown.worst = worstOf(run, pose);
  if (const auto& nearest = pose.clearance) {
    shown.clearance = ReplayNearest{nearest->part, nearest->blade, nearest->depth, {}};
  }
  return shown;
}

void addFindings(const GrindingRun& run, std::size_t p, std::vector<ReplayFinding>& findings) {
  const PoseReport& pose = run.poses[p];
  if (pose.motion && pose.motion->hasFinding()) {
    const Touch& at = pose.motion->at;
    findings.push_back({static_cast<double>(p) - 1.0 + pose.motion->fraction,
                        verdictOfMotion(pose.motion->outcome), at.part, at.blade, run.faceOf(at), at.depth,
                        p});
  }
  if (pose.verdict < Verdict::near_miss) return;
  ReplayFinding finding{.at = static_cast<double>(p), .verdict = static_cast<std::size_t>(pose.verdict)};
  if (const std::optional<ReplayNearest> worst = worstOf(run, pose)) {
    finding.part = worst->part;
    finding.blade = worst->blade;
    finding.side = worst->side;
    finding.value = worst->depth;
  }
  findings.push_back(finding);
}

std::string ofPoses(std::size_t count, std::size_t total) {
  return std::to_string(count) + " of " + countedText(total, "pose", "poses");
}

std::string titleOf(const GrindingRun& run) {
  const std::size_t bad = run.count(Verdict::interference), unknown = run.count(Verdict::unknown);
  const std::size_t motions =
      run.count(MotionReport::Outcome::hit) + run.count(MotionReport::Outcome::too_deep);
  const std::string on_motions = countedText(motions, "motion", "motions");
  const std::string also = motions == 0 ? "" : " and " + on_motions;
  if (bad > 0) return "Interference at " + ofPoses(bad, run.poses.size()) + also;
  if (unknown > 0) {
    return "Depth unknown at " + ofPoses(unknown, run.poses.size()) + (motions == 0 ? "" : on_motions);
  }
  if (motions > 0) return "Interference on " + on_motions;
  const std::string none = "No interference at " + countedText(run.poses.size(), "pose", "poses");
  const std::size_t open = run.motionCount() - run.depthsProved();
  return open == 0 ? none : none + ", depth not proved on " + countedText(open, "motion", "motions");
}

std::string subtitleOf(const GrindingRun& run) {
  std::string text = run.isPartial()
                         ? "Stopped after " + ofPoses(run.poses.size(), run.job.path.size()) + ". "
                         : std::string();
  const int blade = run.job.rules.ground_blade;
  text += blade == 0 ? std::string("No blade is ground")
                     : "Blade " + std::to_string(blade) + " of " + std::to_string(run.job.blades.count) +
                           " is ground";
  const PoseReport& shown = run.poses[poseToShow(run)];
  if (shown.verdict >= Verdict::unknown) {
    text += "; worst is pose " + std::to_string(poseToShow(run)) + ", " + describeWorst(run, shown);
  }
  return text;
}

/// "all", "blade 3", …: the blades of a rule.
std::string bladeChoiceText(const BladeChoice& choice) {
  switch (choice.kind) {
    case BladeChoice::Kind::any:
      return "all";
    case BladeChoice::Kind::hub:
      return "hub or shroud";
    case BladeChoice::Kind::ground:
      return "ground blade";
    case BladeChoice::Kind::number:
      return "blade " + std::to_string(choice.number);
  }
  return {};
}

Table partsTable(const GrindingRun& run) {
  Table table{.name = "parts",
              .caption = "Parts of the tool",
              .columns = {"Part", "Triangles", "May touch", "Greatest depth, mm", "Depth measured"}};
  for (std::size_t part = 0; part < run.job.parts.size(); ++part) {
    std::string touches;
    const auto add = [&](const std::string& what) {
      if (!touches.empty()) touches += ", ";
      touches += what;
    };
    if (part == run.job.rules.grinding_part && run.job.rules.ground_blade != 0) {
      add("ground blade " + std::to_string(run.job.rules.ground_blade));
    }
    for (const AllowedPair& pair : run.job.rules.allowed) {
      if (pair.part.value_or(part) == part) add(bladeChoiceText(pair.blade));
    }
    constexpr std::array kHow = {"as solids", "as an open surface in the solid blisk"};
    const auto how = static_cast<std::size_t>(run.depth_kinds[part]);
    table.rows.push_back(
        {run.job.parts[part].name, std::to_string(run.job.parts[part].tree->mesh().triangleCount()),
         touches.empty() ? "nothing" : touches,
         touches.empty() ? std::string("–") : shortText(run.job.rules.maxDepth(part)), kHow[how]});
  }
  return table;
}

Table limitsTable(const GrindingRun& run) {
  Table table{.name = "limits", .caption = "Limits and tolerances"};
  table.rows.push_back({"Near miss", "closer than " + shortText(run.job.rules.near_miss) + " mm"});
  for (const PairMargin& row : run.job.rules.margins) {
    const std::string part = row.part ? run.job.parts[*row.part].name : std::string("every part");
    table.rows.push_back({"Near miss, " + part, "closer than " + shortText(row.near_miss) + " mm to " +
                                                    bladeChoiceText(row.blade)});
  }
  if (run.job.continuous) {
    table.rows.push_back({"Motions", "proved to stay " + shortText(kMotionTolerance) +
                                         " mm away from all forbidden surfaces"});
    table.rows.push_back({"Depth on motions", depthOnMotions(run)});
  } else {
    table.rows.push_back({"Motions", "not checked, only poses"});
  }
  table.rows.push_back({"Depths", "to 1 % of the limit"});
  table.rows.push_back({"Touch", "exact on the triangles"});
  return table;
}

Table inputTable(const GrindingRun& run) {
  const BuildStats& tree = run.job.blisk->stats();
  return {.name = "input",
          .caption = "Input",
          .rows = {{"Blisk", run.blisk_name},
                   {"Triangles of the blisk", std::to_string(tree.triangles)},
                   {"Blades of the blisk", std::to_string(run.job.blades.count)},
                   {"Tree of the blisk", partitionText(run.job.blisk->options()) + ", " +
                                             std::to_string(tree.leaves) + " leaf boxes on up to " +
                                             std::to_string(tree.depth) + " levels"},
                   {"Tool", run.tool_name},
                   {"Path", run.path_name},
                   {"Poses of the path", std::to_string(run.job.path.size())}}};
}

}  // namespace

std::vector<ReplayVerdict> grindingVerdicts() {
  std::vector<ReplayVerdict> verdicts;
  constexpr std::array kTones = {Tone::clear, Tone::intended, Tone::near, Tone::open, Tone::interference};
  for (std::size_t v = 0; v < kTones.size(); ++v) {
    verdicts.push_back({nameOf(static_cast<Verdict>(v)), kTones[v]});
  }
  verdicts.push_back({"motion hits", Tone::interference});
  verdicts.push_back({"motion too deep", Tone::interference});
  verdicts.push_back({"motion not proved", Tone::open});
  return verdicts;
}

ReplayTrack grindingTrack(const GrindingRun& run, const std::string& name) {
  ReplayTrack track{.name = name};
  ReplaySeries clearance{.name = "clearance from forbidden surfaces", .unit = "mm"};
  ReplaySeries depth{.name = "depth of the worst touch, as a negative value", .unit = "mm"};
  for (std::size_t p = 0; p < run.poses.size(); ++p) {
    track.poses.push_back(replayPoseOf(run, run.poses[p]));
    const ReplayPose& shown = track.poses.back();
    clearance.values.push_back(shown.clearance ? -shown.clearance->depth : kNoValue);
    depth.values.push_back(shown.worst && shown.worst->depth >= 0.0 ? 0.0 - shown.worst->depth : kNoValue);
    addFindings(run, p, track.findings);
  }
  track.series = {std::move(clearance), std::move(depth)};
  return track;
}

ReplayChart clearanceChart(const GrindingRun& run) {
  constexpr double kLinear = 0.1;  // mm
  ReplayChart chart{.title = "Clearance and depth over the path", .unit = "mm", .linear_within = kLinear};
  chart.limits.push_back({run.job.rules.near_miss, "near miss below " + shortText(run.job.rules.near_miss)});
  if (run.job.rules.grinding_part != kNoPart) {
    const double most = run.job.rules.maxDepth(run.job.rules.grinding_part);
    chart.limits.push_back({-most, "greatest intended depth " + shortText(most)});
  }
  return chart;
}

std::vector<Table> grindingFacts(const GrindingRun& run) {
  return {partsTable(run), limitsTable(run), inputTable(run), versionsTable()};
}

Replay grindingReplay(const GrindingRun& run, const std::optional<Coverage>& coverage) {
  Replay replay;
  replay.command = "grind";
  replay.title = titleOf(run);
  replay.subtitle = subtitleOf(run);
  if (coverage) {
    replay.title += ". " + groundText(*coverage);
    replay.side = coverageOnBlade(*coverage);
  }
  replay.findings_title = "Poses and motions with interference or near misses";
  replay.findings_value = "Depth, mm";
  replay.no_findings = "No interference, and no near miss.";
  replay.verdicts = grindingVerdicts();
  for (std::size_t v = 0; v <= static_cast<std::size_t>(Verdict::interference); ++v) {
    const auto verdict = static_cast<Verdict>(v);
    if (verdict == Verdict::unknown && run.count(verdict) == 0) continue;
    replay.counts.push_back({nameOf(verdict), run.count(verdict), replay.verdicts[v].tone});
  }
  if (run.job.continuous) {
    replay.counts.push_back(
        {"motions that hit, or too deep",
         run.count(MotionReport::Outcome::hit) + run.count(MotionReport::Outcome::too_deep),
         Tone::interference});
    if (const std::size_t open = run.count(MotionReport::Outcome::not_proved); open > 0) {
      replay.counts.push_back({"motions not proved", open, Tone::open});
    }
  }
  replay.blisk = run.job.blisk;
  replay.blade_of_triangle = run.job.blades.blade_of_triangle;
  replay.blade_count = run.job.blades.count;
  replay.ground_blade = run.job.rules.ground_blade;
  replay.fixtures = run.job.fixtures;
  replay.parts = run.job.parts;
  replay.charts = {clearanceChart(run)};
  replay.tracks.push_back(grindingTrack(run, "path"));
  replay.start_at = static_cast<double>(poseToShow(run));
  replay.facts = grindingFacts(run);
  replay.notes.push_back(
      "A negative depth is a clearance. Blades are numbered from 1 by angle; poses are counted from 0. "
      "Normals point from the part into the blisk and are drawn on the part's side. Between two poses the "
      "contact wheel's centre moves straight and the tool rotates at a constant rate, here as in the check.");
  return replay;
}

}  // namespace octoblisk::demos
