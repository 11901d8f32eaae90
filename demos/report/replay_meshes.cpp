#include "report/replay_meshes.h"

namespace octoblisk::demos {

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
