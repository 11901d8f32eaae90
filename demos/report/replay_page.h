// Writes a replay as one HTML page that needs no other file and no network.
#pragma once

#include <filesystem>

#include "report/replay_json.h"

namespace octoblisk::demos {

/// Writes the page. Throws std::runtime_error naming a file that cannot be written.
void writeReplayPage(const Replay& replay, const ReplayMeshes& meshes, const std::filesystem::path& file,
                     const ReplayLimits& limits = {});

}  // namespace octoblisk::demos
