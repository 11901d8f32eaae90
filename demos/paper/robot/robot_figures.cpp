#include "paper/robot/robot_figures.h"

#include <algorithm>
#include <array>
#include <functional>

#include "paper/robot/arm_bodies.h"
#include "render/picture.h"
#include "render/plot.h"

namespace octoblisk::demos {
namespace {

constexpr std::size_t kMaxStretches = 250;  // per line: more would blur

using ValueOf = std::function<double(const RobotTick&)>;

/// The greatest value in each of a few hundred intervals of time.
Series greatest(const RobotRun& run, const std::string& name, const ValueOf& value) {
  Series series{.name = name, .x = {}, .y = {}, .style = SeriesStyle::line};
  const std::size_t stretch = run.ticks.size() / kMaxStretches + 1;
  for (std::size_t begin = 0; begin < run.ticks.size(); begin += stretch) {
    const std::size_t end = std::min(begin + stretch, run.ticks.size());
    double most = value(run.ticks[begin]);
    for (std::size_t k = begin + 1; k < end; ++k) most = std::max(most, value(run.ticks[k]));
    series.x.push_back(run.ticks[begin].time);
    series.y.push_back(most);
  }
  return series;
}

Plot errorPlot(const RobotRun& run) {
  return {.title = "Errors of the simulated robot along the path",
          .x_label = "time (s)",
          .y_label = "error of the contact wheel's centre (mm)",
          .series = {greatest(run, "tracking", [](const RobotTick& tick) { return tick.position_error; }),
                     greatest(run, "sensing", [](const RobotTick& tick) { return tick.sensing_error; })}};
}

Plot timePlot(const RobotRun& run) {
  const auto seconds = [](RobotMethod method) {
    return [method](const RobotTick& tick) {
      return 1e3 * static_cast<double>(tick.seconds[static_cast<std::size_t>(method)]);
    };
  };
  const double period = 1e3 * run.options.control_period;
  return {.title = "Detection time per tick",
          .x_label = "time along the path (s)",
          .y_label = "detection time (ms)",
          .y_log = true,
          .series = {{.name = "control period",
                      .x = {0.0, run.ticks.back().time},
                      .y = {period, period},
                      .style = SeriesStyle::dashed_line},
                     greatest(run, "traditional", seconds(RobotMethod::traditional)),
                     greatest(run, "improved", seconds(RobotMethod::improved)),
                     greatest(run, "exact, yes or no", seconds(RobotMethod::yes_or_no)),
                     greatest(run, "exact, contacts", seconds(RobotMethod::exact)),
                     greatest(run, "with margin", seconds(RobotMethod::margin))}};
}

Picture cellPicture(const RobotReport& report, const RobotScene& scene) {
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
  return picture;
}

}  // namespace

std::vector<Figure> drawRobotFigures(const RobotReport& report, const RobotScene& scene,
                                     const std::filesystem::path& folder) {
  const RobotRun& run = report.runs.front();
  writeSvg(errorPlot(run), folder / "table4_errors.svg");
  writeSvg(timePlot(run), folder / "table4_times.svg");
  writePng(cellPicture(report, scene), (folder / "table4_cell.png").string());
  const std::string stretches = " of the first run: the greatest value in each of at most " +
                                std::to_string(kMaxStretches) + " intervals of time.";
  return {{"table4_errors.svg",
           "Distance of the wheel's centre from its target (tracking) and of the measured centre from the "
           "true one (sensing)," +
               stretches},
          {"table4_times.svg",
           "Detection times in processor time; \"contacts\" are all those in Bullet," + stretches},
          {"table4_cell.png", "The cell in Bullet: arm, grinder and blisk (fig. 11b of the paper)."}};
}

}  // namespace octoblisk::demos
