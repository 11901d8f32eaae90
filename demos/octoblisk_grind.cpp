// The octoblisk command with `grind` alone, for who wants to see a belt on a blade soon.
#include "command_line/command_line.h"
#include "commands/commands.h"

int main(int argc, char** argv) {
  using namespace octoblisk::demos;
  return runCommandLine(argc, argv, OCTOBLISK_VERSION, {addGrindCommand});
}
