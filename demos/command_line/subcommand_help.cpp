#include "command_line/subcommand_help.h"

#include <map>
#include <string_view>

#include "io/embedded_file.h"

// The files, by their names.
#define OCTOBLISK_HELP_FILES(X) \
  X(octoblisk)                  \
  X(access) X(blades) X(check) X(gallery) X(grind) X(inspect) X(make) X(merge) X(paper) X(path) X(repair)

#define OCTOBLISK_EMBED_HELP(name) OCTOBLISK_EMBED(octoblisk_help_##name, OCTOBLISK_HELP "/" #name ".txt");
OCTOBLISK_HELP_FILES(OCTOBLISK_EMBED_HELP)

namespace octoblisk::demos {
namespace {

Help helpIn(std::string_view text) {
  constexpr std::string_view kEmptyLine = "\n\n";
  text.remove_suffix(1);  // the last line's end
  const std::size_t end = text.find(kEmptyLine);
  return {std::string(text.substr(0, end)), std::string(text.substr(end + kEmptyLine.size()))};
}

}  // namespace

const Help& helpOf(const std::string& command) {
#define OCTOBLISK_KNOWN_HELP(name) {#name, helpIn(OCTOBLISK_EMBEDDED(octoblisk_help_##name))},
  static const std::map<std::string, Help> known = {OCTOBLISK_HELP_FILES(OCTOBLISK_KNOWN_HELP)};
  return known.at(command);
}

CLI::App& addSubcommand(CLI::App& app, const std::string& name) {
  const Help& help = helpOf(name);
  CLI::App& command = *app.add_subcommand(name, help.about);
  command.footer(help.footer);
  return command;
}

}  // namespace octoblisk::demos
