#include "report/grinding_report.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <sstream>
#include <vector>

#include "grinding/belt_loop.h"
#include "grinding/blade_side.h"
#include "grinding/motion_check.h"
#include "io/new_file.h"
#include "io/number_text.h"
#include "report/grinding_pictures.h"

namespace octoblisk::demos {
namespace {

/// The definition of a part's depth in poses.csv.
std::string nameOf(DepthKind kind) {
  switch (kind) {
    case DepthKind::of_solids:
      return "the depth of the part's deepest point in the blisk; if it is within the limit and the depth of "
             "the blisk's deepest point in the part is not, the latter";
    case DepthKind::of_part:
      return "the depth of the deepest point of the part, which is open, in the blisk";
  }
  return {};
}

std::string nameOf(MotionReport::Outcome outcome) {
  switch (outcome) {
    case MotionReport::Outcome::free:
      return "free";
    case MotionReport::Outcome::not_checked:
      return "not checked";
    case MotionReport::Outcome::hit:
      return "hit";
    case MotionReport::Outcome::too_deep:
      return "too deep";
    case MotionReport::Outcome::not_proved:
      return "not proved";
  }
  return {};
}

/// "arm,3": two cells.
std::string partAndBody(const GrindingRun& run, const Touch& touch) {
  return run.job.parts[touch.part].name + ',' + run.names().cellOf(touch.blade);
}

/// The worst touch or, without one, the nearest place.
void writeTouch(const GrindingRun& run, const Touch& touch, std::ostream& stream) {
  stream << partAndBody(run, touch) << ',' << touch.depth << ',' << run.sideOf(touch);
  for (const double value : touch.contact.point_on_a) stream << ',' << value;
  for (const double value : touch.contact.normal) {
    stream << ',';
    if (!touch.contact.normal.isZero()) stream << value;
  }
}

void writePose(const GrindingRun& run, const PoseReport& pose, std::ostream& stream) {
  const Touch* const worst = worstOrNearest(pose);
  const std::optional<Touch>& clearance = pose.clearance;
  const std::optional<MotionReport>& motion = pose.motion;
  stream << nameOf(pose.verdict) << ',';
  if (worst) {
    writeTouch(run, *worst, stream);
  } else {
    stream << ",,,,,,,,,";
  }
  stream << ',';
  if (clearance) stream << clearance->contact.distance;
  stream << ',' << (clearance ? partAndBody(run, *clearance) : ",") << ',';
  if (motion) stream << nameOf(motion->outcome);
  stream << ',';
  if (motion) stream << motion->fraction;
  stream << ',' << (motion && motion->hasFinding() ? partAndBody(run, motion->at) : ",") << ',';
  if (run.convex_side && worst) stream << run.faceOf(*worst);
  stream << ',' << (worst ? channelOf(run.sideOf(*worst), worst->blade, run.job.blades.count) : "") << ',';
  if (motion) stream << motion->depth_bound;
  stream << '\n';
}

/// The loops of the parts that run as belts; null for the others.
std::vector<std::unique_ptr<const BeltLoop>> loopsOf(const GrindingRun& run) {
  std::vector<std::unique_ptr<const BeltLoop>> loops;
  for (const ToolPart& part : run.job.parts) {
    loops.push_back(part.belt_speed ? std::make_unique<const BeltLoop>(part.tree->mesh()) : nullptr);
  }
  return loops;
}

void writeVelocity(const BeltLoop* loop, const ToolPart& part, const Pose& tool_in_blisk, const Vec3& point,
                   std::ostream& stream) {
  if (!loop) {
    stream << ",,,";
    return;
  }
  const Vec3 velocity =
      *part.belt_speed * (tool_in_blisk.rotation * loop->directionAt(tool_in_blisk.inverse() * point));
  for (const double value : velocity) stream << ',' << value + 0.0;
}

}  // namespace

std::vector<PoseRange> interferingRanges(const GrindingRun& run) {
  std::vector<PoseRange> ranges;
  for (std::size_t pose = 0; pose < run.poses.size(); ++pose) {
    if (run.poses[pose].verdict < Verdict::unknown) continue;
    const bool goes_on = !ranges.empty() && ranges.back().last + 1 == pose;
    if (!goes_on) ranges.push_back({pose, pose});
    ranges.back().last = pose;
  }
  return ranges;
}

void writePoseVerdicts(const GrindingRun& run, const std::filesystem::path& file) {
  std::ostringstream stream;
  stream.precision(9);
  stream
      << "pose,verdict,part,blade,depth_mm,side,blisk_x_mm,blisk_y_mm,blisk_z_mm,normal_x,normal_y,normal_z,"
         "clearance_mm,clearance_part,clearance_blade,motion,motion_fraction,motion_part,motion_blade,face,"
         "channel,"
         "motion_depth_at_most_mm\n";
  for (std::size_t p = 0; p < run.poses.size(); ++p) {
    stream << p << ',';
    writePose(run, run.poses[p], stream);
  }
  writeFile(file, stream.str());
}

void writeContacts(const GrindingRun& run, const std::filesystem::path& file) {
  std::ostringstream stream;
  stream.precision(9);
  stream << "pose,contact_verdict,part,blade,triangle_blisk,triangle_part,"
            "blisk_x_mm,blisk_y_mm,blisk_z_mm,part_x_mm,part_y_mm,part_z_mm,"
            "normal_x,normal_y,normal_z,depth_mm,velocity_x_m_s,velocity_y_m_s,velocity_z_m_s\n";
  const auto loops = loopsOf(run);
  for (std::size_t p = 0; p < run.poses.size(); ++p) {
    const PoseReport& pose = run.poses[p];
    for (const Touch& touch : pose.touches) {
      if (touch.is_inside) continue;
      const Contact& contact = touch.contact;
      stream << p << ',' << nameOf(touch.verdict) << ',' << partAndBody(run, touch) << ','
             << contact.triangle_a << ',' << contact.triangle_b;
      for (const Vec3& v : {contact.point_on_a, contact.point_on_b, contact.normal}) {
        stream << ',' << v.x() << ',' << v.y() << ',' << v.z();
      }
      stream << ',' << 0.0 - contact.distance;  // 0, not -0, for a mere touch
      writeVelocity(loops[touch.part].get(), run.job.parts[touch.part], pose.tool_in_blisk,
                    contact.point_on_b, stream);
      stream << '\n';
    }
  }
  writeFile(file, stream.str());
}

void writeForces(const GrindingRun& run, const std::filesystem::path& file) {
  std::ostringstream stream;
  stream.precision(9);
  stream << "pose,verdict,normal_force_n,friction_force_n,force_x_n,force_y_n,force_z_n,torque_n_m,"
            "acceleration_rad_s2\n";
  for (std::size_t p = 0; p < run.loads.size(); ++p) {
    if (!run.loads[p]) continue;
    const SpindleLoad& load = *run.loads[p];
    stream << p << ',' << nameOf(run.poses[p].verdict) << ',' << load.normal_force << ','
           << load.friction_force;
    for (const double value : load.force) stream << ',' << value;
    stream << ',' << load.torque << ',' << load.acceleration << '\n';
  }
  writeFile(file, stream.str());
}

namespace {

/// Null if no forces were asked for.
nlohmann::ordered_json forcesOf(const GrindingRun& run) {
  if (!run.job.spindle) return {};
  std::size_t touching = 0, turning = 0, interfering = 0;
  double sum = 0.0, most = 0.0, torque = 0.0;
  for (std::size_t p = 0; p < run.loads.size(); ++p) {
    const std::optional<SpindleLoad>& load = run.loads[p];
    if (!load) continue;
    ++touching;
    interfering += run.poses[p].verdict >= Verdict::unknown;
    sum += load->normal_force;
    most = std::max(most, load->normal_force);
    torque = std::max(torque, std::abs(load->torque));
    constexpr double kAtRest = 1e-3;  // rad/s²
    turning += std::abs(load->acceleration) > kAtRest;
  }
  return {{"stiffness_n_mm", run.job.spindle->stiffness},
          {"friction", run.job.spindle->friction},
          {"hold_n_m", run.job.spindle->hold},
          {"density_kg_mm3", run.job.spindle->density},
          {"poses_that_touch", touching},
          {"poses_of_them_that_interfere", interfering},
          {"mean_normal_force_n", touching > 0 ? sum / static_cast<double>(touching) : 0.0},
          {"greatest_normal_force_n", most},
          {"greatest_torque_n_m", torque},
          {"poses_at_which_the_spindle_turns", turning}};
}

/// Null if nothing is ground.
nlohmann::ordered_json coverageJson(const std::optional<Coverage>& coverage) {
  if (!coverage) return {};
  const SideGrid& grid = coverage->grid;
  const auto part = [](std::size_t line, std::size_t count) {
    return static_cast<double>(line) / static_cast<double>(count);
  };
  nlohmann::ordered_json json = {{"blade", coverage->blade},
                                 {"side", coverage->side},
                                 {"ground_share", coverage->share(CellState::ground)},
                                 {"too_deep_share", coverage->share(CellState::too_deep)},
                                 {"left_standing_share", coverage->share(CellState::left_standing)},
                                 {"not_reached_share", coverage->share(CellState::not_reached)},
                                 {"height_reached", nullptr},
                                 {"chord_reached", nullptr},
                                 {"left_between_passes_mm", nullptr}};
  if (const auto rows = coverage->reachedRows()) {
    json["height_reached"] = {part(rows->first, grid.rows()), part(rows->second + 1, grid.rows())};
  }
  if (const auto columns = coverage->reachedColumns()) {
    json["chord_reached"] = {part(columns->first, grid.columns()), part(columns->second + 1, grid.columns())};
  }
  const double scallop = coverage->scallopHeight();
  if (std::isfinite(scallop)) json["left_between_passes_mm"] = scallop;
  return json;
}

}  // namespace

void writeSummary(const GrindingRun& run, const std::optional<Coverage>& coverage,
                  const std::filesystem::path& file) {
  const BuildStats& tree = run.job.blisk->stats();
  nlohmann::ordered_json parts = nlohmann::ordered_json::array();
  for (std::size_t part = 0; part < run.job.parts.size(); ++part) {
    parts.push_back({{"name", run.job.parts[part].name},
                     {"triangles", run.job.parts[part].tree->stats().triangles},
                     {"max_depth_mm", run.job.rules.maxDepth(part)},
                     {"depth_mm_is", nameOf(run.depth_kinds[part])}});
    if (run.job.parts[part].belt_speed) parts.back()["belt_speed_m_s"] = *run.job.parts[part].belt_speed;
  }
  nlohmann::ordered_json ranges = nlohmann::ordered_json::array();
  for (const auto& [first, last] : interferingRanges(run))
    ranges.push_back({{"first", first}, {"last", last}});
  const int blade = run.job.rules.ground_blade;
  nlohmann::ordered_json ground_blade;  // null
  if (blade != 0) ground_blade = blade;
  nlohmann::ordered_json motions;  // null if they were not checked
  if (run.job.continuous) {
    motions = {{"total", run.motionCount()},
               {"free", run.count(MotionReport::Outcome::free)},
               {"not_checked", run.count(MotionReport::Outcome::not_checked)},
               {"hit", run.count(MotionReport::Outcome::hit)},
               {"too_deep", run.count(MotionReport::Outcome::too_deep)},
               {"not_proved", run.count(MotionReport::Outcome::not_proved)},
               {"proved_to_mm", kMotionTolerance},
               {"depth_proved", run.depthsProved()},
               {"depth_on_motions_at_most_mm", run.depthBound()}};
  }
  auto obstacles = nlohmann::ordered_json::array();
  for (const Fixture& fixture : run.job.fixtures) obstacles.push_back(fixture.name);
  const nlohmann::ordered_json summary = {
      {"partial", run.isPartial()},
      {"poses_of_path", run.job.path.size()},
      {"blisk", {{"file", run.blisk_name}, {"triangles", tree.triangles}, {"blades", run.job.blades.count}}},
      {"tool", run.tool_name},
      {"obstacles", obstacles},
      {"path", run.path_name},
      {"parts", parts},
      {"limits",
       {{"ground_blade", ground_blade},
        {"max_depth_mm", run.job.rules.max_depth},
        {"near_miss_mm", run.job.rules.near_miss}}},
      {"poses",
       {{"total", run.poses.size()},
        {"clear", run.count(Verdict::clear)},
        {"intended_contact", run.count(Verdict::intended_contact)},
        {"near_miss", run.count(Verdict::near_miss)},
        {"unknown", run.count(Verdict::unknown)},
        {"interference", run.count(Verdict::interference)}}},
      {"interfering_poses", ranges},
      {"motions", motions},
      {"forces", forcesOf(run)},
      {"coverage", coverageJson(coverage)},
      {"tree",
       {{"partition", partitionText(run.job.blisk->options())},
        {"build_s", run.tree_seconds},
        {"nodes_of_up_to_8_boxes", tree.nodes},
        {"leaf_boxes", tree.leaves},
        {"boxes_round_deepest_leaf", tree.depth},
        {"leaf_boxes_mm3", tree.leaf_volume}}},
      {"mean_us_a_pose",
       {{"contacts", run.per_pose.contacts * 1e6},
        {"depths", run.per_pose.depths * 1e6},
        {"clearances", run.per_pose.clearances * 1e6},
        {"motions", run.per_pose.motions * 1e6}}}};
  std::ostringstream stream;
  stream << summary.dump(2) << '\n';
  writeFile(file, stream.str());
}

namespace {

/// "poses 20-79, 228": the runs that interfere; only the first of them if there are many.
std::string listOf(const std::vector<PoseRange>& ranges) {
  constexpr std::size_t kMaxRuns = 12;
  std::ostringstream text;
  text << (ranges.size() == 1 && ranges[0].first == ranges[0].last ? "pose " : "poses ");
  for (std::size_t i = 0; i < std::min(ranges.size(), kMaxRuns); ++i) {
    text << (i > 0 ? ", " : "") << ranges[i].first;
    if (ranges[i].last != ranges[i].first) text << '-' << ranges[i].last;
  }
  if (ranges.size() > kMaxRuns)
    text << " and " << countedText(ranges.size() - kMaxRuns, "more run", "more runs") << " (summary.json)";
  return text.str();
}

void writeMotionCounts(const GrindingRun& run, std::ostream& text) {
  using Outcome = MotionReport::Outcome;
  const std::size_t hits = run.count(Outcome::hit), deep = run.count(Outcome::too_deep),
                    open = run.count(Outcome::not_proved), unchecked = run.count(Outcome::not_checked);
  text << "Between the poses: ";
  if (hits + deep + open == 0) {
    text << "no touch other than at the poses";
  } else {
    text << "motions that hit a forbidden surface: " << hits << ", that are too deep: " << deep
         << ", undecided within " << kMotionTolerance << " mm: " << open;
  }
  if (unchecked > 0) text << "; not checked, because a part interferes at one of the poses: " << unchecked;
  text << '\n';
  if (hits + deep + open == 0) return;
  const auto first = std::ranges::find_if(
      run.poses, [](const PoseReport& pose) { return pose.motion && pose.motion->hasFinding(); });
  text << "First: after " << first->motion->fraction << " of the motion to pose " << first - run.poses.begin()
       << ", " << run.job.parts[first->motion->at.part].name << " on "
       << run.names().nameOf(first->motion->at.blade) << '\n';
}

}  // namespace

std::string summaryText(const GrindingRun& run) {
  std::ostringstream text;
  const int blade = run.job.rules.ground_blade;
  const std::string blades = std::to_string(run.job.blades.count);
  if (run.isPartial())
    text << "Stopped: " << run.poses.size() << " of " << run.job.path.size() << " poses were checked\n";
  text << run.poses.size() << (run.poses.size() == 1 ? " pose, " : " poses, ");
  if (blade == 0) {
    text << "no blade ground (the blisk has " << blades << ")";
  } else {
    text << "ground blade " << blade << " of " << blades;
    if (run.job.rules.grinding_part != kNoPart) {
      text << " (intended up to " << run.job.rules.maxDepth(run.job.rules.grinding_part) << " mm deep)";
    }
  }
  text << ": " << run.count(Verdict::clear) << " clear, " << run.count(Verdict::intended_contact)
       << " intended contact, " << run.count(Verdict::near_miss) << " near miss, "
       << run.count(Verdict::interference) << " interference";
  if (const std::size_t unknown = run.count(Verdict::unknown); unknown > 0) {
    text << ", " << unknown << " unknown (the depth is unknown: the blisk's mesh has a hole near the tool)";
  }
  if (!run.interferes() && run.depthsProved() < run.motionCount()) {
    text << "; depth not proved on "
         << countedText(run.motionCount() - run.depthsProved(), "motion", "motions") << ": at most "
         << shortText(run.depthBound()) << " mm";
  }
  text << '\n';
  if (run.job.blisk->options().partition == PartitionKind::paper) {
    text << "Partition: " << partitionText(run.job.blisk->options()) << "; tree built in " << run.tree_seconds
         << " s, contacts in " << run.per_pose.contacts * 1e6 << " us per pose\n";
  }
  const PoseReport& shown = run.poses[poseToShow(run)];
  if (shown.verdict >= Verdict::unknown) {
    text << (run.count(Verdict::unknown) > 0 ? "Interference or unknown depth at " : "Interference at ")
         << listOf(interferingRanges(run)) << ", counted from 0\n";
    text << "Worst: pose " << poseToShow(run) << ", " << describeWorst(run, shown) << '\n';
  }
  if (run.job.continuous && run.motionCount() > 0) {
    writeMotionCounts(run, text);
    if (run.depthBound() > 0.0) text << "Depth between the poses: " << depthOnMotions(run) << '\n';
  }
  return text.str();
}

std::string depthOnMotions(const GrindingRun& run) {
  const std::size_t motions = run.motionCount(), proved = run.depthsProved();
  std::ostringstream text;
  text << "proved within the limit on " << proved << " of " << motions
       << (motions == 1 ? " motion" : " motions");
  if (proved == motions) return text.str();
  text << "; not proved on the others, but at most " << shortText(run.depthBound()) << " mm";
  return text.str();
}

std::string partitionText(const BuildOptions& options) {
  if (options.partition == PartitionKind::clustering) return "clustered";
  const std::string k = options.clusters == 0 ? "k_opt" : "k = " + std::to_string(options.clusters);
  return "paper, " + k + ", FNOP " + std::to_string(options.leaf_capacity);
}

}  // namespace octoblisk::demos
