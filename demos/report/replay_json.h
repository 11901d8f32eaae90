// A replay as JSON, for its page.
#pragma once

#include <cstddef>
#include <string>

#include "report/replay_meshes.h"

namespace octoblisk::demos {

/// What is drawn may be less than what was checked; the page then says so.
struct ReplayLimits {
  std::size_t boxes = 80'000;
  std::size_t contacts = 150'000;  ///< of each track
};

/// The run as JSON that may stand in a <script> of a page: no "<" is in it, whatever names hold.
std::string replayJson(const Replay& replay, const ReplayMeshes& meshes, const ReplayLimits& limits = {});

}  // namespace octoblisk::demos
