// Figures 13 and 14: a section of the blade, and the errors along it, before and after grinding.
#pragma once

#include <filesystem>
#include <vector>

#include "paper/cmm/cmm_experiment.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Draws those of the middle section into the folder. Throws as writeSvg.
std::vector<Figure> drawCmmFigures(const CmmExperiment& experiment, const std::filesystem::path& folder);

}  // namespace octoblisk::demos
