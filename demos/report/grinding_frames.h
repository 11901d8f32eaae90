// Frames of a grinding run: pictures of poses along its path, and all of them on a sheet.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "report/grinding_report.h"
#include "report/whole_files.h"

namespace octoblisk::demos {

/// So many poses at equal steps, the first and the last among them; all, where there are no more.
std::vector<std::size_t> posesOfFrames(std::size_t pose_count, std::size_t frames);

/// Adds frame_POSE.png for each of so many poses (>= 1), and frames.png, the contact sheet.
/// Throws std::runtime_error naming a file that cannot be written.
void writeFrames(const GrindingRun& run, std::size_t frames, const std::filesystem::path& folder,
                 WholeFiles& files);

}  // namespace octoblisk::demos
