#include "command_line/command_line.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <ios>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "command_line/complain.h"
#include "command_line/help_formatter.h"
#include "command_line/manual.h"
#include "command_line/subcommand_help.h"
#include "command_line/subcommand_names.h"
#include "study/launch.h"
#include "study/stop_signal.h"

namespace octoblisk::demos {
namespace {

/// The command with the subcommands that were given: "octoblisk make belt".
std::string commandAskedFor(const CLI::App& app) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  return app.get_name() + (given.empty() ? "" : ' ' + commandAskedFor(*given.front()));
}

}  // namespace

int runCommandLine(int argc, char** argv, const std::string& version,
                   std::initializer_list<AddCommand> subcommands) {
  const Help& help = helpOf("octoblisk");
  CLI::App app{help.about};
  app.name("octoblisk");
  app.formatter(std::make_shared<HelpFormatter>());
  app.require_subcommand(1);
  app.set_version_flag("--version", "octoblisk " + version, "The version, and no more");
  app.set_help_all_flag("--help-all", "Help of every subcommand");
  app.footer(help.footer);
  app.add_option("--manual", "The manual of all subcommands, as Markdown or for man(1), and no more")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"markdown", "man"}))
      ->each([&](const std::string& format) {
        std::cout << (format == "man" ? manualForMan(app, version) : manualInMarkdown(app));
        throw CLI::Success();
      });

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
  } catch (const CLI::Success& help_or_version) {
    exit_code = app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    complain(error.what() + ("; see " + commandAskedFor(app) + " --help"));
    exit_code = 2;
  } catch (const Stopped& stopped) {
    complain(stopped.what());
    exit_code = stopped.exitCode();
  } catch (const std::exception& error) {
    complain(error.what());
    exit_code = 2;
  }
  return is_first ? exit_code : 0;
}

}  // namespace octoblisk::demos
