#include "paper/robot/robot_scene.h"

#include <algorithm>
#include <utility>

#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "octoblisk/collide.h"
#include "paper/robot/arm_bodies.h"

namespace octoblisk::demos {

RobotScene robotScene(const PaperModel& blisk, std::vector<Points> clouds, std::vector<Pose> path) {
  RobotScene scene{.blisk = treeOf(blisk.mesh),
                   .blades = blisk.blades,
                   .tool = {},
                   .clouds = std::move(clouds),
                   .path = std::move(path)};
  for (EmbeddedPart& part : embeddedBeltGrinder()) {
    scene.tool.push_back({std::move(part.name), treeOf(std::move(part.mesh))});
  }
  return scene;
}

TrueTouch::TrueTouch(const RobotScene& scene, int ground_blade, const SixAxisArm& arm)
    : scene_(scene), ground_blade_(ground_blade) {
  for (const LinkBody& body : linkBodies(arm)) links_.emplace_back(meshOf(body).vertices());
}

Touches TrueTouch::of(const Pose& tool_in_blisk) {
  Touches touches;
  touchingPairs(*scene_.blisk, *scene_.tool.front().tree, tool_in_blisk, pairs_);
  touches.belt = !pairs_.empty();
  touches.forbidden = std::ranges::any_of(pairs_, [&](const TrianglePair& pair) {
    return scene_.blades.blade_of_triangle[pair.a] != ground_blade_;
  });
  for (std::size_t part = 1; part < scene_.tool.size() && !touches.forbidden; ++part) {
    touches.forbidden = collide(*scene_.blisk, *scene_.tool[part].tree, tool_in_blisk).has_value();
  }
  return touches;
}

bool TrueTouch::ofArm(const std::array<Pose, 6>& links_in_blisk) const {
  for (std::size_t link = 0; link < links_.size(); ++link) {
    if (collide(*scene_.blisk, links_[link], links_in_blisk[link])) return true;
  }
  return false;
}

}  // namespace octoblisk::demos
