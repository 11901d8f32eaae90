// The report on the paper's experiments: the template report.jsonnet, filled with their numbers.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "render/document.h"
#include "render/plot.h"

namespace octoblisk::demos {

struct PaperPlot {
  std::string file;
  Plot plot;
};

struct PaperReport {
  Document document;
  std::vector<PaperPlot> plots;    ///< those among the document's figures
  std::vector<Table> more_tables;  ///< not in the document
};

/// `run` has what the template reads; its first lines say what. Throws std::logic_error if something is
/// missing.
PaperReport paperReport(const nlohmann::json& run);

/// Draws the plots and writes the document and all tables to a folder that has the other figures. Throws as
/// writeSvg and writeReport.
void writePaperReport(const PaperReport& report, const std::filesystem::path& folder);

}  // namespace octoblisk::demos
