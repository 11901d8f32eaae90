// A replay as JSON, for its page.
#pragma once

#include <cstddef>
#include <string>

#include "report/replay.h"

namespace octoblisk::demos {

/// Limits of what the page draws; the page says so if it draws less than was checked.
struct ReplayLimits {
  std::size_t boxes = 80'000;
  std::size_t contacts = 150'000;  ///< per track
};

/// The run as JSON that can be embedded in a <script>: it contains no "<", whatever the names contain.
std::string replayJson(const Replay& replay, const ReplayMeshes& meshes, const ReplayLimits& limits = {});

}  // namespace octoblisk::demos
