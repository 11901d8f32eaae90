#include "command_line/help_formatter.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace octoblisk::demos {
namespace {

/// Characters, not bytes, of UTF-8.
std::size_t lengthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](unsigned char byte) { return (byte & 0xC0) != 0x80; }));
}

/// "TEXT:{a,b}", as CLI11 writes a choice, as "a|b".
std::string placeholderOf(const CLI::Option& option) {
  std::string name = option.get_option_text().empty() ? option.get_type_name() : option.get_option_text();
  const std::size_t begin = name.find(":{");
  if (begin == std::string::npos || !name.ends_with('}')) return name;
  std::string choices = name.substr(begin + 2, name.size() - begin - 3);
  std::ranges::replace(choices, ',', '|');
  return choices;
}

std::string namesOf(const std::set<CLI::Option*>& options) {
  std::string names;
  for (const CLI::Option* option : options) names += (names.empty() ? "" : ", ") + option->get_name();
  return names;
}

/// A head, and beside it, or below where it is long, its text.
std::string entryOf(const std::string& head, const std::string& text) {
  constexpr std::size_t kIndentation = 2, kColumn = 30;
  std::string entry = std::string(kIndentation, ' ') + head;
  std::size_t at = kIndentation + lengthOf(head);
  for (const std::string& line : wrapped(text, kHelpWidth - kColumn)) {
    if (at + 2 > kColumn) {
      entry += '\n';
      at = 0;
    }
    entry += std::string(kColumn - at, ' ') + line;
    at = kHelpWidth;
  }
  return entry + '\n';
}

}  // namespace

std::string headOf(const CLI::Option& option) {
  std::string head;
  const auto add = [&](const std::string& name) { head += (head.empty() ? "" : ", ") + name; };
  for (const std::string& name : option.get_snames()) add('-' + name);
  for (const std::string& name : option.get_lnames()) add("--" + name);
  if (head.empty()) head = option.get_name(true);
  const bool has_value = option.get_type_size() != 0;
  if (has_value && option.nonpositional() && !placeholderOf(option).empty()) {
    head += ' ' + placeholderOf(option);
  }
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
