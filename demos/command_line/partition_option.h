// The option that chooses the partition of trees: our own, or the paper's.
#pragma once

#include <CLI/App.hpp>

#include "octoblisk/build_options.h"

namespace octoblisk::demos {

/// Adds --partition clustered|paper[:K[:FNOP]]. Without K each part has its k_opt.
void addPartitionOption(CLI::App& command, BuildOptions& options);

}  // namespace octoblisk::demos
