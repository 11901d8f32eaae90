#include "paper/robot/robot_scene.h"

#include <utility>

#include "models/embedded_assets.h"
#include "models/shared_tree.h"

namespace octoblisk::demos {

RobotScene robotScene(const PaperModel& blisk, std::vector<Points> clouds, std::vector<Pose> path) {
  RobotScene scene;
  scene.blisk = treeOf(blisk.mesh);
  scene.blades = blisk.blades;
  for (EmbeddedPart& part : embeddedBeltGrinder()) {
    scene.tool.push_back({std::move(part.name), treeOf(std::move(part.mesh))});
  }
  scene.clouds = std::move(clouds);
  scene.path = std::move(path);
  return scene;
}

}  // namespace octoblisk::demos
