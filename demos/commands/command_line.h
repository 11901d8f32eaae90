// The octoblisk command: one file a subcommand, beside this one.
#pragma once

#include <string>

namespace octoblisk::demos {

/// Runs what main() is asked for. Returns its exit code: 0 clean, 1 interference found, 2 bad input.
int runCommandLine(int argc, char** argv, const std::string& version);

}  // namespace octoblisk::demos
