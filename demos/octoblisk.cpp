// The octoblisk command.
#include "command_line/command_line.h"
#include "commands/commands.h"

int main(int argc, char** argv) {
  using namespace octoblisk::demos;
  return runCommandLine(argc, argv, OCTOBLISK_VERSION,
                        {addGrindCommand, addBladesCommand, addPathCommand, addAccessCommand,
                         addRepairCommand, addPlanCommand, addMakeCommand, addCheckCommand, addInspectCommand,
                         addMergeCommand, addPaperCommand, addGalleryCommand});
}
