#include "command_line/help.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include "io/embedded_file.h"

// The files, by their names.
#define OCTOBLISK_HELP_FILES(X) \
  X(octoblisk)                  \
  X(access)                     \
  X(blades) X(check) X(gallery) X(grind) X(inspect) X(make) X(merge) X(paper) X(path) X(plan) X(repair)

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

/// Characters, not bytes, of UTF-8.
std::size_t lengthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](unsigned char byte) { return (byte & 0xC0) != 0x80; }));
}

std::string namesOf(const std::set<CLI::Option*>& options) {
  std::string names;
  for (const CLI::Option* option : options) names += (names.empty() ? "" : ", ") + option->get_name();
  return names;
}

/// A head, and beside it, or below where it is long, its text.
std::string entryOf(const std::string& head, const std::string& text) {
  constexpr std::size_t kColumn = 30;
  std::ostringstream entry;
  CLI::detail::format_help(entry, head, CLI::detail::join(wrapped(text, kHelpWidth - kColumn), "\n"),
                           kColumn);
  return entry.str();
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

std::string headOf(const CLI::Option& option) {
  std::string head;
  const auto add = [&](const std::string& name) { head += (head.empty() ? "" : ", ") + name; };
  for (const std::string& name : option.get_snames()) add('-' + name);
  for (const std::string& name : option.get_lnames()) add("--" + name);
  if (head.empty()) head = option.get_name(true);
  const bool has_value = option.get_type_size() != 0;
  if (option.nonpositional() && !option.get_type_name().empty()) head += ' ' + option.get_type_name();
  if (has_value && option.get_expected_max() >= CLI::detail::expected_max_vector_size) head += " ...";
  return head;
}

std::string textOf(const CLI::Option& option) {
  std::string facts;
  const auto add = [&](const std::string& fact) { facts += (facts.empty() ? "" : "; ") + fact; };
  if (option.get_required()) add("required");
  if (option.get_type_size() != 0 && !option.get_default_str().empty()) {
    add("default: " + option.get_default_str());
  }
  if (!option.get_needs().empty()) add("needs " + namesOf(option.get_needs()));
  if (!option.get_excludes().empty()) add("excludes " + namesOf(option.get_excludes()));
  return option.get_description() + (facts.empty() ? "" : " [" + facts + "]");
}

std::string summaryOf(const CLI::App& command) {
  const std::string description = command.get_description();
  return description.substr(0, description.find('\n'));
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lengthOf(lines.back()) + 1 + lengthOf(word) > width) {
      lines.push_back(word);
    } else {
      lines.back() += ' ' + word;
    }
  }
  return lines;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool) const {
  return entryOf(headOf(*option), textOf(*option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return entryOf(command->get_name(), summaryOf(*command));
}

}  // namespace octoblisk::demos
