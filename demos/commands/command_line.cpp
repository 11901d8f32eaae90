#include "commands/command_line.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <ios>
#include <iostream>

#include "commands/subcommand_names.h"
#include "study/launch.h"
#include "study/stop_signal.h"

namespace octoblisk::demos {

int runCommandLine(int argc, char** argv, const std::string& version,
                   std::initializer_list<AddCommand> subcommands) {
  CLI::App app{
      "OctoBlisk: checks an abrasive belt against a bladed disk (blisk), exactly on the triangles.\n"
      "Lengths are in mesh units; the generated models and the grinding check are in mm."};
  app.name("octoblisk");
  app.require_subcommand(1);
  app.set_version_flag("--version", "octoblisk " + version, "The version, and no more");
  app.set_help_all_flag("--help-all", "Help of every subcommand");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("octoblisk: ") + error.what() + "; see --help\n";
  });
  app.footer(
      "Mesh files are read with coordinates rounded to 32-bit floats.\n"
      "Exit codes: 0 clean, 1 interference found or a motion not proved free, 2 bad input.");

  int exit_code = 0;
  for (const AddCommand add : subcommands) add(app, exit_code);

  // Of several processes, one speaks, and its exit code counts.
  const bool is_first = launchedAs().rank == 0;
  if (!is_first) {
    std::cout.setstate(std::ios::failbit);
    std::cerr.setstate(std::ios::failbit);
  }
  try {
    requireKnownSubcommands(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
  } catch (const Stopped& stopped) {
    std::cerr << "octoblisk: " << stopped.what() << '\n';
    exit_code = stopped.exitCode();
  } catch (const std::exception& error) {
    std::cerr << "octoblisk: " << error.what() << '\n';
    exit_code = 2;
  }
  return is_first ? exit_code : 0;
}

}  // namespace octoblisk::demos
