// What grind and repair tell about a run alike.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "command_line/grinder_input.h"
#include "command_line/print_message.h"
#include "grinding/coverage.h"

namespace octoblisk::demos {

/// Names the sources of blisk, tool and path.
inline void nameInputs(const GrinderFiles& files, GrindingRun& run) {
  run.blisk_name = files.blisk.empty() ? "default" : files.blisk;
  run.tool_name = files.toolName();
  run.path_name = files.path.empty() ? "generated" : files.path;
}

/// The coverage of a path. None, with a warning, for a blade whose side has no contours.
inline std::optional<Coverage> coverageOrWarning(const GrinderFiles& files, const GrindingJob& job,
                                                 std::span<const Pose> path,
                                                 std::optional<BladeSide> convex) {
  try {
    return coverageOf(job, path, convex);
  } catch (const std::invalid_argument& error) {
    warnOf(files.bliskName(), std::string("the coverage is not computed: ") + error.what());
    return std::nullopt;
  }
}

}  // namespace octoblisk::demos
