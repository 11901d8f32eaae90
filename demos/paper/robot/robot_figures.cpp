#include "paper/robot/robot_figures.h"

#include <array>

#include "paper/robot/arm_bodies.h"
#include "render/picture.h"

namespace octoblisk::demos {

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
