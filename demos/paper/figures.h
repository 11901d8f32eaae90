// Figures 2, 4, 5, 7 and 8 of the paper, for our belt and blade.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "paper/paper_model.h"
#include "paper/progress.h"
#include "render/flow_chart.h"

namespace octoblisk::demos {

/// Figure 7: the flow chart of the paper's algorithm as this project runs it.
FlowChart algorithmChart();

/// Draws figures 2, 4, 5, 7 and 8 into the folder. The result has the files and captions of the four whose
/// captions depend on the model. Throws as writePng and writeSvg.
nlohmann::json drawFigures(const PaperModel& model, const TriangleMesh& belt, const Points& cloud,
                           std::uint64_t seed, const std::filesystem::path& folder, const Progress& progress);

}  // namespace octoblisk::demos
