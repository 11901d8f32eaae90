// The octoblisk command: one file a subcommand, in commands/.
//
// Exit codes: 0 clean, 1 interference found, 2 bad input.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "commands/commands.h"
#include "commands/subcommand_names.h"

int main(int argc, char** argv) {
  CLI::App app{
      "OctoBlisk: checks an abrasive belt against a bladed disk (blisk), exactly on the triangles.\n"
      "Lengths are in mesh units; the generated models and the grinding check are in mm."};
  app.name("octoblisk");
  app.require_subcommand(1);
  app.set_version_flag("--version", "octoblisk " OCTOBLISK_VERSION, "The version, and no more");
  app.set_help_all_flag("--help-all", "Help of every subcommand");
  app.footer(
      "Mesh files are read with coordinates rounded to 32-bit floats.\n"
      "Exit codes: 0 clean, 1 interference found, 2 bad input.");

  int exit_code = 0;
  octoblisk::demos::addGrindCommand(app, exit_code);
  octoblisk::demos::addMakeCommand(app, exit_code);
  octoblisk::demos::addCheckCommand(app, exit_code);
  octoblisk::demos::addPaperCommand(app, exit_code);

  try {
    octoblisk::demos::requireKnownSubcommands(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "octoblisk: " << error.what() << '\n';
    return 2;
  }
  return exit_code;
}
