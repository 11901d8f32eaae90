// docs/command.md and the man page have the same content as --help.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "pages/page_test.h"

namespace octoblisk::pages {
namespace {

using demos::contentOf;
using demos::ScratchFolder;
using ::testing::HasSubstr;

/// The options of each command, by its full name.
using Options = std::map<std::string, std::set<std::string>>;

/// Adds the options in `head`, except the help options, which every command has.
void add(std::set<std::string>& options, const std::string& head) {
  for (const std::string& option : found(head, "(--[a-z][a-z0-9-]*)")) {
    if (!option.starts_with("--help")) options.insert(option);
  }
}

std::string helpOf(const ScratchFolder& folder, const std::string& command) {
  return runScript(folder, command + " --help").out;
}

/// Collects the options of the command and all its subcommands.
void askForHelp(const ScratchFolder& folder, const std::string& command, Options& options) {
  std::istringstream lines(helpOf(folder, command));
  std::set<std::string>& its = options[command];
  bool is_list = false, is_subcommand = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(' ')) {
      is_list = line.ends_with(':');
      is_subcommand = line == "Subcommands:";
    } else if (is_list && line[2] != ' ') {
      const std::string head = line.substr(2, line.find("  ", 2) - 2);
      if (is_subcommand) {
        askForHelp(folder, command + ' ' + head, options);
      } else {
        add(its, head);
      }
    }
  }
}

/// "octoblisk make belt, arm" is two commands.
std::vector<std::string> commandsOf(std::string heading) {
  if (const std::size_t last = heading.rfind(" and "); last != std::string::npos) {
    heading.replace(last, 5, ", ");
  }
  const std::string first = heading.substr(0, heading.find(',')),
                    parent = first.substr(0, first.rfind(' ') + 1);
  std::vector<std::string> commands = {first};
  for (const std::string& name : found(heading, ", ([a-z0-9-]+)")) commands.push_back(parent + name);
  return commands;
}

Options optionsOfPage() {
  Options options;
  std::istringstream lines(contentOf(kProject / "docs/command.md"));
  std::vector<std::string> commands = {"octoblisk"};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ") || line.starts_with("### ")) {
      commands = commandsOf(line.substr(line.find(' ') + 1));
    }
    for (const std::string& command : commands) {
      std::set<std::string>& its = options[command];
      if (line.starts_with("- `")) add(its, line);
    }
  }
  return options;
}

TEST(Manual, isUpToDate) {
  const ScratchFolder folder;
  EXPECT_EQ(contentOf(kProject / "docs/command.md"), runScript(folder, "octoblisk --manual markdown").out)
      << "run ./dev manual";
}

TEST(Manual, hasEveryOptionOfHelpAndNoOther) {
  const ScratchFolder folder;
  Options options;
  askForHelp(folder, "octoblisk", options);
  EXPECT_EQ(optionsOfPage(), options);
  EXPECT_GE(options.size(), 20u);
  EXPECT_TRUE(options["octoblisk grind"].contains("--spindle"));
  const std::string man = runScript(folder, "octoblisk --manual man").out;
  EXPECT_THAT(man, HasSubstr("\n.SH NAME\n"));
  for (const auto& [command, its] : options) {
    for (std::string option : its) EXPECT_THAT(man, HasSubstr(replaced(option, "-", "\\-"))) << command;
  }
}

TEST(Manual, helpFitsATerminal) {
  const ScratchFolder folder;
  Options options;
  askForHelp(folder, "octoblisk", options);
  for (const auto& [command, its] : options) {
    std::istringstream lines(helpOf(folder, command));
    for (std::string line; std::getline(lines, line);) {
      std::erase_if(line, [](unsigned char byte) { return (byte & 0xC0) == 0x80; });
      EXPECT_LE(line.size(), 110u) << command << ": " << line;
    }
  }
}

/// Calls of octoblisk in sentences name existing commands and options.
TEST(Manual, hasWhatSentencesName) {
  const Options options = optionsOfPage();
  int calls = 0;
  for (const std::string& page : pagesOf(kProject)) {
    for (std::string call : found(contentOf(kProject / page), "[^`]`(octoblisk [a-z][^`]*)`")) {
      for (char& letter : call) letter = letter == '\n' ? ' ' : letter;
      std::istringstream words(call);
      std::string command, word;
      words >> command;
      while (words >> word && options.contains(command + ' ' + word)) command += ' ' + word;
      EXPECT_NE(command, "octoblisk") << page << ": " << call;
      for (const std::string& option : found(call, "(--[a-z][a-z0-9-]*)")) {
        EXPECT_TRUE(option == "--help" || options.at(command).contains(option)) << page << ": " << call;
      }
      ++calls;
    }
  }
  EXPECT_GE(calls, 20);
}

}  // namespace
}  // namespace octoblisk::pages
