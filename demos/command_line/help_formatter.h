// How --help is laid out.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

namespace octoblisk::demos {

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
