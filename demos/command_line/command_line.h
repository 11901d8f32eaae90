// The octoblisk command line.
#pragma once

#include <CLI/App.hpp>
#include <initializer_list>
#include <string>

namespace octoblisk::demos {

/// Adds a subcommand, which sets the exit code when it has run: see commands.h.
using AddCommand = void (*)(CLI::App& app, int& exit_code);

/// Runs the subcommand that the arguments of main() name; --help lists the subcommands in this order. Returns
/// the exit code: 0 clean, 1 interference found, 2 bad input.
int runCommandLine(int argc, char** argv, const std::string& version,
                   std::initializer_list<AddCommand> subcommands);

}  // namespace octoblisk::demos
