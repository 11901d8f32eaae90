// Figures 9 and 10: plots of Tables 1 and 2.
#pragma once

#include <filesystem>

#include "paper/split_run.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Draws our numbers and the paper's into the folder. Throws as writeSvg.
Section splitPlotsSection(const SplitRun& run, const std::filesystem::path& folder);

}  // namespace octoblisk::demos
