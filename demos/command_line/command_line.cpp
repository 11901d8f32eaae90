#include "command_line/command_line.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <ios>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "command_line/help_formatter.h"
#include "command_line/manual.h"
#include "command_line/print_message.h"
#include "command_line/subcommand_help.h"
#include "command_line/subcommand_names.h"
#include "study/launch.h"
#include "study/stop_signal.h"

namespace octoblisk::demos {
namespace {

/// The command with its given subcommands: "octoblisk make belt".
std::string commandAskedFor(const CLI::App& app) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  return app.get_name() + (given.empty() ? "" : ' ' + commandAskedFor(*given.front()));
}

/// CLI11's message, in the style of ours.
std::string messageOf(const CLI::ParseError& error) {
  struct Rewritten {
    std::string_view error;  // empty: any, because errors about extra arguments have the command's name
    std::string_view theirs, ours;
  };
  constexpr Rewritten kRewritten[] = {
      {"", "The following argument was not expected:", "unknown argument:"},
      {"", "The following arguments were not expected:", "unknown arguments:"},
      {"ExcludesError", " excludes ", " cannot be used with "},
      {"RequiresError", " requires ", " needs "},
      {"ArgumentMismatch", ": 1 required ", ": "},
      {"ArgumentMismatch", " missing", " is missing"},
      {"RequiredError", "A subcommand", "a subcommand"}};
  std::string message = error.what();
  for (const auto& [name, theirs, ours] : kRewritten) {
    const std::size_t place = message.find(theirs);
    const bool is_this = name.empty() ? place == 0 : place != std::string::npos && error.get_name() == name;
    if (is_this) message.replace(place, theirs.size(), ours);
  }
  return message;
}

}  // namespace

int runCommandLine(int argc, char** argv, const std::string& version,
                   std::initializer_list<AddCommand> subcommands) {
  const Help& help = helpOf("octoblisk");
  CLI::App app{help.about};
  app.name("octoblisk");
  app.formatter(std::make_shared<HelpFormatter>());
  app.require_subcommand(1);
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.set_version_flag("--version", "octoblisk " + version, "Print the version and exit");
  app.set_help_all_flag("--help-all", "Print the help of all subcommands and exit");
  app.footer(help.footer);
  app.add_option("--manual", "Print the manual of all subcommands, as Markdown or for man(1), and exit")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"markdown", "man"}))
      ->each([&](const std::string& format) {
        std::cout << (format == "man" ? manualForMan(app, version) : manualInMarkdown(app));
        throw CLI::Success();
      });

  int exit_code = 0;
  for (const AddCommand add : subcommands) add(app, exit_code);

  // Only the first of several processes prints, and only its exit code counts.
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
    printMessage(messageOf(error) + "; see " + commandAskedFor(app) + " --help");
    exit_code = 2;
  } catch (const Stopped& stopped) {
    printMessage(stopped.what());
    exit_code = stopped.exitCode();
  } catch (const std::exception& error) {
    printMessage(error.what());
    exit_code = 2;
  }
  return is_first ? exit_code : 0;
}

}  // namespace octoblisk::demos
