// The manual of the command: every subcommand and option as --help has it, on one page.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace octoblisk::demos {

/// In Markdown: docs/command.md, which `./dev manual` writes.
std::string manualInMarkdown(const CLI::App& app);

/// For man(1); the build installs it.
std::string manualForMan(const CLI::App& app, const std::string& version);

}  // namespace octoblisk::demos
