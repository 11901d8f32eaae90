// Checks the names of subcommands and suggests the nearest one.
#pragma once

#include <CLI/CLI.hpp>

namespace octoblisk::demos {

/// Throws std::invalid_argument naming the first word of the command line that should be a subcommand and is
/// not, with a list of those that exist.
void requireKnownSubcommands(const CLI::App& app, int argc, const char* const* argv);

}  // namespace octoblisk::demos
