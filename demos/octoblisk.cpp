#include "commands/command_line.h"

int main(int argc, char** argv) { return octoblisk::demos::runCommandLine(argc, argv, OCTOBLISK_VERSION); }
