// A finished experiment of Tables 1 and 2, as the report needs it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "paper/split_experiment.h"
#include "render/document.h"

namespace octoblisk::demos {

struct SplitRun {
  std::string blade_name;
  std::size_t points = 0;
  SplitResult result;
  /// nodeRatios of several clouds and seeds.
  std::vector<std::array<double, kMethods - 1>> ratios_of_seeds{};
};

/// All cells of both tables, one a row.
Table splitCells(const SplitRun& run);

}  // namespace octoblisk::demos
