// A replay as one HTML page that needs no other file and no network.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "report/replay_meshes.h"

namespace octoblisk::demos {

/// What is drawn may be less than what was checked; the page then says so.
struct ReplayLimits {
  std::size_t boxes = 80'000;
  std::size_t contacts = 150'000;  ///< of each track
};

/// The run as JSON that may stand in a <script> of a page: no "<" is in it, whatever names hold.
std::string replayJson(const Replay& replay, const ReplayMeshes& meshes, const ReplayLimits& limits = {});

/// Writes the page. Throws std::runtime_error naming a file that cannot be written.
void writeReplayPage(const Replay& replay, const ReplayMeshes& meshes, const std::filesystem::path& file,
                     const ReplayLimits& limits = {});

}  // namespace octoblisk::demos
