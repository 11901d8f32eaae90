#include "report/replay.h"

#include <array>

namespace octoblisk::demos {

std::string colorOfPart(const std::string& name, std::size_t index) {
  constexpr std::array kOthers = {"#8fc1d9", "#b9a7d6", "#9fc79a", "#d9a58f", "#c2c27a"};
  if (name.starts_with("belt")) return "#e0c48c";
  if (name.starts_with("arm")) return "#6d7f95";
  if (name.ends_with("wheel")) return "#9ecbe4";
  return kOthers[index % kOthers.size()];
}

ReplayMeshes replayMeshesOf(const Replay& replay, const DrawnTriangles& most) {
  ReplayMeshes meshes;
  const Surroundings all = surroundingsOf(replay.blisk->sharedMesh(), replay.blade_of_triangle,
                                          replay.blade_count, replay.fixtures);
  meshes.blisk = displayMeshOf(*all.mesh, all.body_of_triangle, most.blisk);
  for (const ToolPart& part : replay.parts) {
    meshes.parts.push_back(displayMeshOf(part.tree->mesh(), {}, most.part));
  }
  return meshes;
}

}  // namespace octoblisk::demos
