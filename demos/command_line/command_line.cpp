#include "command_line/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <ios>
#include <iostream>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "command_line/help.h"
#include "command_line/manual.h"
#include "command_line/print_message.h"
#include "io/quoted_text.h"
#include "study/launch.h"
#include "study/stop_signal.h"

namespace octoblisk::demos {
namespace {

/// The number of letters to insert, delete or replace to turn one word into the other.
std::size_t editDistance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

[[noreturn]] void refuse(std::string_view word, const std::vector<const CLI::App*>& known) {
  constexpr std::size_t kTypingErrors = 2;
  std::string nearest, names;
  std::size_t least = kTypingErrors + 1;
  for (const CLI::App* subcommand : known) {
    const std::string& name = subcommand->get_name();
    names += (names.empty() ? "" : ", ") + name;
    const std::size_t distance = editDistance(word, name);
    if (distance >= least) continue;
    least = distance;
    nearest = name;
  }
  throw std::invalid_argument(
      inQuotes(word) + " is not a subcommand" + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
      (nearest.empty() ? "; the subcommands are: " : " The subcommands are: ") + names);
}

/// Throws std::invalid_argument naming the first word of the command line that should be a subcommand and is
/// not, with a list of those that exist.
void requireKnownSubcommands(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = &app;
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    const std::vector<const CLI::App*> known = command->get_subcommands([](const CLI::App*) { return true; });
    if (known.empty()) return;
    const auto named = std::ranges::find(known, std::string(argv[i]), &CLI::App::get_name);
    if (named == known.end()) refuse(argv[i], known);
    command = *named;
  }
}

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
      ->type_name("markdown|man")
      ->check(CLI::IsMember({"markdown", "man"}).description(""))
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
