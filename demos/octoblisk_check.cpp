// The octoblisk command with its subcommand check alone: see check.cmake.
#include "command_line/command_line.h"
#include "commands/commands.h"

int main(int argc, char** argv) {
  using namespace octoblisk::demos;
  return runCommandLine(argc, argv, OCTOBLISK_VERSION, {addCheckCommand});
}
