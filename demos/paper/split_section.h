// What the report says of Tables 1 and 2 and figures 9 and 10.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "paper/split_experiment.h"
#include "report/document.h"

namespace octoblisk::demos {

/// A finished experiment, as its sections need it.
struct SplitRun {
  std::string blade_name;
  std::size_t points = 0;
  SplitResult result;
  /// nodeRatios of several clouds and seeds.
  std::vector<std::array<double, kMethods - 1>> ratios_of_seeds{};
};

/// Table 1: counts of nodes beside the paper's, then what they are to stand for: leaf volumes, false
/// positives and negatives; k_opt.
Section nodesSection(const SplitRun& run);

/// Table 2: split times beside the paper's.
Section timesSection(const SplitRun& run);

/// Figures 9 and 10, drawn into the folder: here, and in the paper. Throws as writeSvg.
Section splitPlotsSection(const SplitRun& run, const std::filesystem::path& folder);

/// All cells of both tables, one a row.
Table splitCells(const SplitRun& run);

}  // namespace octoblisk::demos
