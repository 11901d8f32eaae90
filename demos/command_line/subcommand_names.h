// The names of subcommands, and what is near them.
#pragma once

#include <CLI/CLI.hpp>

namespace octoblisk::demos {

/// Throws std::invalid_argument naming the first word of the command line that should be a subcommand and is
/// none, with those that there are.
void requireKnownSubcommands(const CLI::App& app, int argc, const char* const* argv);

}  // namespace octoblisk::demos
