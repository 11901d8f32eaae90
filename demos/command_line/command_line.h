// The octoblisk command: one file a subcommand, beside this one.
#pragma once

#include <CLI/App.hpp>
#include <initializer_list>
#include <string>

namespace octoblisk::demos {

/// Adds a subcommand, which leaves its exit code when it ran: see commands.h.
using AddCommand = void (*)(CLI::App& app, int& exit_code);

/// Runs what main() is asked for, one of the subcommands, which --help lists in this order. Returns its exit
/// code: 0 clean, 1 interference found, 2 bad input.
int runCommandLine(int argc, char** argv, const std::string& version,
                   std::initializer_list<AddCommand> subcommands);

}  // namespace octoblisk::demos
