// The meshes of a replay as they are drawn.
#pragma once

#include <cstddef>
#include <vector>

#include "render/display_mesh.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// Triangles beyond which a mesh is thinned (display_mesh.h).
struct DrawnTriangles {
  std::size_t blisk = 150'000;
  std::size_t part = 40'000;  ///< of each
};

struct ReplayMeshes {
  DisplayMesh blisk;  ///< its groups are the blades
  std::vector<DisplayMesh> parts;
};

ReplayMeshes replayMeshesOf(const Replay& replay, const DrawnTriangles& most = {});

}  // namespace octoblisk::demos
