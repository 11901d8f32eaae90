// The help of the command and its subcommands: the text files in help/.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace octoblisk::demos {

struct Help {
  std::string about;  ///< the file up to its first empty line: above the options. Its first line is a summary
  std::string footer;  ///< the rest: below them. Paragraphs, and items that begin with "- "
};

/// Of a subcommand, or of "octoblisk" itself. Throws std::out_of_range where there is no such file.
const Help& helpOf(const std::string& command);

/// Adds a subcommand with its help.
CLI::App& addSubcommand(CLI::App& app, const std::string& name);

}  // namespace octoblisk::demos
