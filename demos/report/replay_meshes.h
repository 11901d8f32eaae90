// The meshes that a replay draws.
#pragma once

#include <cstddef>
#include <vector>

#include "render/display_mesh.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// Meshes with more triangles are simplified (display_mesh.h).
struct DrawnTriangles {
  std::size_t blisk = 150'000;
  std::size_t part = 40'000;  ///< per part
};

struct ReplayMeshes {
  DisplayMesh blisk;  ///< one group per blade
  std::vector<DisplayMesh> parts;
};

ReplayMeshes replayMeshesOf(const Replay& replay, const DrawnTriangles& most = {});

}  // namespace octoblisk::demos
