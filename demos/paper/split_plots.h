// Figures 9 and 10: the numbers of Tables 1 and 2, drawn.
#pragma once

#include <filesystem>

#include "paper/split_run.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Drawn into the folder: here, and in the paper. Throws as writeSvg.
Section splitPlotsSection(const SplitRun& run, const std::filesystem::path& folder);

}  // namespace octoblisk::demos
