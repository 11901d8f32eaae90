// The option --partition: our division of triangles into trees, or the paper's.
#pragma once

#include <CLI/App.hpp>

#include "octoblisk/build_options.h"

namespace octoblisk::demos {

/// Adds --partition clustered|paper[:K[:FNOP]]. Without K, each part gets its k_opt.
void addPartitionOption(CLI::App& command, BuildOptions& options);

}  // namespace octoblisk::demos
