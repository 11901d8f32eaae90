#include "paper/robot/robot_report.h"

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>

#include "build/paper/principal_box.h"
#include "paper/robot/arm_bodies.h"
#include "render/picture.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr std::size_t kRuns = 3;         // along the path, as in the paper
constexpr std::size_t kTicksToOne = 16;  // of the first run: one of these is used over the seeds

void add(RobotAlarms& sum, const RobotAlarms& alarms) {
  sum.alarms += alarms.alarms;
  sum.missed += alarms.missed;
  sum.false_alarms += alarms.false_alarms;
}

std::vector<Pose> someTicks(const RobotRun& run) {
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < run.ticks.size(); k += kTicksToOne) poses.push_back(run.ticks[k].tool_in_blisk);
  return poses;
}

constexpr std::size_t kMostStretches = 250;  // per line of a plot: more would blur

/// The plots of a run: the greatest value in each of a few hundred intervals of time.
nlohmann::json plotsOf(const RobotRun& run) {
  nlohmann::json plots = {{"most_stretches", kMostStretches}, {"end", run.ticks.back().time}};
  const std::size_t stretch = run.ticks.size() / kMostStretches + 1;
  for (std::size_t begin = 0; begin < run.ticks.size(); begin += stretch) {
    const std::span ticks = std::span(run.ticks).subspan(begin, std::min(stretch, run.ticks.size() - begin));
    const auto greatest = [&](const auto& value) {
      return std::invoke(value, *std::ranges::max_element(ticks, {}, value));
    };
    plots["time"].push_back(ticks.front().time);
    plots["tracking"].push_back(greatest(&RobotTick::position_error));
    plots["sensing"].push_back(greatest(&RobotTick::sensing_error));
    for (std::size_t m = 0; m < kRobotMethods; ++m) {
      plots["seconds"][m].push_back(greatest([m](const RobotTick& tick) { return double{tick.seconds[m]}; }));
    }
  }
  return plots;
}

nlohmann::json numbersOf(const RobotRun& run) {
  nlohmann::json json = {{"ticks", run.ticks.size()},
                         {"duration", run.duration},
                         {"mean_position_error", run.mean_position_error},
                         {"worst_position_error", run.worst_position_error},
                         {"worst_direction_error", run.worst_direction_error},
                         {"mean_sensing_error", run.mean_sensing_error},
                         {"worst_sensing_error", run.worst_sensing_error},
                         {"least_margin_to_limits", run.least_margin_to_limits},
                         {"unreached_ticks", run.unreached_ticks},
                         {"arm_ticks", run.arm.ticks},
                         {"true_arm_ticks", run.arm.true_ticks}};
  for (const RobotMethodResult& method : run.methods) json["mean_seconds"].push_back(method.mean_seconds);
  return json;
}

nlohmann::json optionsOf(const RobotRunOptions& options) {
  return {{"control_period", options.control_period},
          {"speed", options.speed},
          {"turn_rate", options.turn_rate},
          {"steps_per_tick", options.steps_per_tick},
          {"margin", options.margin},
          {"k", options.k_means.k},
          {"leaf_capacity", options.leaf_capacity},
          {"noise",
           {{"encoder", options.noise.encoder},
            {"position", options.noise.position},
            {"direction", options.noise.direction}}}};
}

nlohmann::json numbersOf(const SixAxisArm& arm) {
  nlohmann::json json = {
      {"lengths",
       {arm.shoulder_height, arm.shoulder_offset, arm.upper_arm, arm.elbow_offset, arm.forearm, arm.flange}},
      {"least", arm.least},
      {"greatest", arm.greatest}};
  for (const LinkBody& body : linkBodies(arm)) json["masses"].push_back(body.mass);
  return json;
}

nlohmann::json numbersOf(const RobotAlarms& alarms) {
  return {{"missed", alarms.missed}, {"false_alarms", alarms.false_alarms}};
}

/// The totals of each method.
nlohmann::json totalsOf(std::span<const RobotRun> runs) {
  nlohmann::json json;
  for (std::size_t m = 0; m < kRobotMethods; ++m) {
    const RobotTotals totals = totalsOf(runs, static_cast<RobotMethod>(m));
    json.push_back({{"range", runs.front().methods[m].range},
                    {"ticks", totals.ticks},
                    {"touching", totals.touching},
                    {"forbidden", totals.forbidden},
                    {"mean_seconds", totals.mean_seconds},
                    {"usual_seconds", totals.usual_seconds},
                    {"worst_seconds", totals.worst_seconds},
                    {"worst_clock_seconds", totals.worst_clock_seconds},
                    {"late", totals.late},
                    {"touch", numbersOf(totals.touch)},
                    {"wrong", numbersOf(totals.wrong)}});
  }
  return json;
}

}  // namespace

RobotReport runRobotExperiment(const RobotScene& scene, const std::vector<Pose>& lifted_path,
                               const RobotRunOptions& options,
                               const std::function<std::vector<Points>(std::uint64_t seed)>& parts_of_seed,
                               const Progress& progress) {
  RobotReport report;
  report.path_poses = scene.path.size();
  const CellLayout layout = chooseLayout(report.arm, scene.path, scene.blisk->mesh().bounds(), report.stand);
  const auto stretch = [&](std::size_t run) {
    constexpr double kShare = 0.8 / (kRuns + 1);
    return stretchOf(progress, kShare * static_cast<double>(run), kShare * static_cast<double>(run + 1));
  };
  RobotRunOptions of_run = options;
  for (std::size_t run = 0; run < kRuns; ++run) {
    of_run.noise.seed = options.noise.seed + run;
    report.runs.push_back(runRobot(scene, layout, of_run, report.arm, report.servo, stretch(run)));
  }
  RobotScene lifted = scene;
  lifted.path = lifted_path;
  of_run.noise.seed = options.noise.seed + kRuns;
  report.lifted = runRobot(lifted, layout, of_run, report.arm, report.servo, stretch(kRuns));
  const DetectionSeedOptions of_seeds{.fnop = options.leaf_capacity, .k_means = options.k_means};
  report.seeds = detectionOverSeeds(parts_of_seed, principalBox(scene.tool.front().tree->mesh().vertices()),
                                    someTicks(report.runs.front()), of_seeds, stretchOf(progress, 0.8, 1.0));
  return report;
}

RobotTotals totalsOf(std::span<const RobotRun> runs, RobotMethod method) {
  RobotTotals sum;
  for (const RobotRun& run : runs) {
    const RobotMethodResult& result = run.of(method);
    sum.ticks += run.ticks.size();
    sum.touching += run.touching_ticks;
    sum.forbidden += run.forbidden_ticks;
    sum.mean_seconds += result.mean_seconds / static_cast<double>(runs.size());
    sum.usual_seconds = std::max(sum.usual_seconds, result.usual_seconds);
    sum.worst_clock_seconds = std::max(sum.worst_clock_seconds, result.worst_clock_seconds);
    sum.worst_seconds = std::max(sum.worst_seconds, result.worst_seconds);
    sum.late += result.late_ticks;
    add(sum.touch, result.touch);
    if (result.forbidden) add(sum.wrong, *result.forbidden);
  }
  return sum;
}

void to_json(nlohmann::json& json, const RobotReport& report) {
  json = {{"path_poses", report.path_poses},
          {"depth", GrindingPathOptions{}.depth},
          {"options", optionsOf(report.runs.front().options)},
          {"arm", numbersOf(report.arm)},
          {"servo",
           {{"position_gain", report.servo.position_gain},
            {"feedforward", report.servo.feedforward},
            {"torque", report.servo.torque}}},
          {"stand", {{"center", report.stand.center}, {"tool_length", report.stand.tool_length}}},
          {"turntable_angle", report.runs.front().layout.turntable_angle},
          {"tool_mass", RobotCellSetup{}.tool_mass},
          {"lifted_run", numbersOf(report.lifted)},
          {"ground", totalsOf(report.runs)},
          {"lifted", totalsOf(std::span(&report.lifted, 1))},
          {"seeds", report.seeds},
          {"plots", plotsOf(report.runs.front())}};
  for (const RobotRun& run : report.runs) json["runs"].push_back(numbersOf(run));
}

void drawRobotCell(const RobotReport& report, const RobotScene& scene, const std::filesystem::path& file) {
  const RobotRun& run = report.runs.front();
  const std::array<Pose, 6> frames = linkFrames(report.arm, run.joints_halfway);
  const std::array<LinkBody, 6> bodies = linkBodies(report.arm);
  Picture picture;
  const LinkBody pedestal{
      Vec3::Zero(), {0.0, 0.0, 0.5 * report.arm.shoulder_height}, 1.2 * bodies[0].radius, 0.0};
  picture.scene.addMesh(meshOf(pedestal), {}, palette::kSlate);
  for (std::size_t link = 0; link < frames.size(); ++link) {
    picture.scene.addMesh(meshOf(bodies[link]), frames[link],
                          link % 2 == 0 ? palette::kOrange : palette::kSand);
  }
  picture.scene.addMesh(scene.blisk->mesh(), run.layout.blisk_in_base, palette::kSteel);
  const Pose tool_in_base = frames.back() * run.layout.tool_in_flange;
  for (const ToolPart& part : scene.tool)
    picture.scene.addMesh(part.tree->mesh(), tool_in_base, palette::kSky);
  std::vector<Vec3> path;
  for (const Pose& pose : scene.path) path.push_back(run.layout.blisk_in_base * pose.translation);
  picture.scene.addPolyline(path, {.color = palette::kPurple, .width = 2.5f, .hidden_opacity = 0.3f});
  picture.annotation = {.title = "The simulated cell, halfway along the path",
                        .subtitle = "The colliding bodies; the blisk's stand is not drawn",
                        .legend = {{palette::kOrange, "arm"},
                                   {palette::kSky, "belt grinder"},
                                   {palette::kSteel, "blisk"},
                                   {palette::kPurple, "path", LegendSymbol::line}},
                        .length_unit = "mm"};
  picture.camera = frame(picture.scene.points(), Vec3(-0.5, 1.0, -0.45), Vec3::UnitZ());
  writePng(picture, file.string());
}

}  // namespace octoblisk::demos
