// The help of the command and its subcommands, from the text files in help/, and its layout.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

namespace octoblisk::demos {

struct Help {
  std::string about;  ///< the file up to its first empty line: above the options. Its first line is a summary
  std::string footer;  ///< the rest: below them. Paragraphs, and items that begin with "- "
};

/// Of a subcommand, or of "octoblisk" itself. Throws std::out_of_range where there is no such file.
const Help& helpOf(const std::string& command);

/// Adds a subcommand with its help.
CLI::App& addSubcommand(CLI::App& app, const std::string& name);

/// No line of --help is longer.
constexpr std::size_t kHelpWidth = 110;

/// An option's names and the placeholder of its value: "-o, --out FOLDER".
std::string headOf(const CLI::Option& option);

/// What an option does; in brackets whether it is required, its default, and which options it needs or
/// excludes.
std::string textOf(const CLI::Option& option);

/// A subcommand in one sentence: the first line of its description.
std::string summaryOf(const CLI::App& command);

/// Words on lines of at most so many characters. Line breaks in the text count as spaces.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

class HelpFormatter final : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace octoblisk::demos
