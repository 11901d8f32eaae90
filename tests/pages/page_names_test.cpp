// Everything that pages name exists. Every code block is of a tested kind. Verbs, presets, programs, options,
// keys and files in blocks are those of the project. tests/consumers compiles the C++.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "pages/page_test.h"

namespace octoblisk::pages {
namespace {

using demos::contentOf;
using demos::Outcome;
using demos::ScratchFolder;
using ::testing::Contains;
using ::testing::HasSubstr;

TEST(Pages, haveNoBlocksButThoseThatAreTested) {
  std::set<Kind> kinds;
  for (const CodeBlock& block : allBlocks()) {
    const std::optional<Kind> kind = kindOf(block);
    ASSERT_TRUE(kind) << block.place() << ": no test covers this kind of block";
    kinds.insert(*kind);
    const std::filesystem::path page = block.page;
    const bool is_compiled = page == "README.md" || page.parent_path() == "docs";
    EXPECT_TRUE(kind != Kind::cpp || is_compiled) << block.place() << ": tests/consumers does not compile it";
    EXPECT_TRUE(kind != Kind::cmake || block.page == "docs/install.md") << block.place();
  }
  EXPECT_EQ(kinds.size(), kBeginnings.size() + kLanguages.size() + 1);  // the tutorial, by its page
}

/// In blocks and in sentences, the verbs of ./dev exist.
TEST(Pages, nameVerbsOfDev) {
  const ScratchFolder folder;
  const Outcome help = runScript(folder, "cd '" + kProject.string() + "'; ./dev help");
  ASSERT_EQ(help.exit_code, 0);
  std::string lines;
  for (const CodeBlock& block : blocksOf(Kind::dev_verbs)) lines += block.text;
  EXPECT_GE(found(lines, R"(\./dev ([a-z-]+))").size(), 5u);
  for (const std::string& page : pagesOf(kProject)) {
    for (const std::string& verb : found(contentOf(kProject / page), R"(\./dev\s+([a-z][a-z-]*))")) {
      EXPECT_THAT(found(help.out, R"(\n  ([a-z-]+) +[a-z])"), Contains(verb)) << page;
    }
  }
  for (const std::string& option : found(lines, "(--[a-z]+)")) EXPECT_THAT(help.out, HasSubstr(option + " "));
  for (const std::string& tasks : found(lines, "--only ([^ ]+)")) {
    for (std::string task : found(tasks, "([a-z-]+)")) {
      std::ranges::replace(task, '-', '_');
      const auto begins = [&](const auto& entry) {
        return entry.path().filename().string().starts_with(task);
      };
      EXPECT_TRUE(std::ranges::any_of(std::filesystem::directory_iterator(kProject / "bench/tasks"), begins))
          << task;
    }
  }
}

TEST(Pages, namePresets) {
  const auto presets = nlohmann::json::parse(contentOf(kProject / "CMakePresets.json"));
  const std::map<std::string, std::string> kinds = {{"cmake --preset", "configurePresets"},
                                                    {"cmake --build --preset", "buildPresets"},
                                                    {"ctest --preset", "testPresets"}};
  for (const CodeBlock& block : blocksOf(Kind::presets)) {
    std::istringstream commands(replaced(block.text, " && ", "\n"));
    for (std::string command; std::getline(commands, command);) {
      const std::size_t space = command.rfind(' ');
      ASSERT_TRUE(kinds.contains(command.substr(0, space))) << command;
      std::vector<std::string> names;
      for (const auto& preset : presets.at(kinds.at(command.substr(0, space))))
        names.push_back(preset.at("name"));
      EXPECT_THAT(names, Contains(command.substr(space + 1))) << block.place();
    }
  }
}

/// The options of CMake that the pages name, in blocks and in sentences, exist.
TEST(Pages, nameOptionsOfTheBuild) {
  const std::string build = contentOf(kProject / "CMakeLists.txt");
  EXPECT_EQ(blocksOf(Kind::libraries).size(), 1u);
  std::set<std::string> options;
  for (const std::string& page : pagesOf(kProject)) {
    for (const std::string& option : found(contentOf(kProject / page), "(OCTOBLISK_BUILD_[A-Z0-9_]+)")) {
      EXPECT_THAT(build, HasSubstr("option(" + option + ' ')) << page;
      options.insert(option);
    }
  }
  EXPECT_GE(options.size(), 5u);
}

TEST(Pages, nameProgramsAndOptionsOfBenchmarks) {
  const std::string session = contentOf(kProject / "bench/session.cpp");
  for (const CodeBlock& block : blocksOf(Kind::benchmark)) {
    for (const std::string& task : found(block.text, "/bench_([a-z_]+)")) {
      EXPECT_TRUE(std::filesystem::exists(kProject / "bench/tasks" / (task + ".cpp"))) << task;
    }
    for (const std::string& option : found(block.text, "(--[a-z_]+)")) {
      EXPECT_TRUE(option.starts_with("--benchmark_") || session.find('"' + option + '"') != std::string::npos)
          << option;
    }
  }
}

TEST(Pages, quoteRowsAsTheyAre) {
  int rows = 0;
  for (const CodeBlock& block : blocksOf(Kind::row)) {
    const std::vector<std::string> keys = found(block.text, "\"([a-z_]+)\"");
    for (const auto& entry : std::filesystem::directory_iterator(kProject / "bench/results")) {
      if (entry.path().extension() != ".json") continue;
      const auto table = nlohmann::ordered_json::parse(contentOf(entry.path()));
      if (!table.is_array()) continue;
      for (const auto& row : table) {
        if (!row.contains("ratio")) continue;
        const bool has_median = entry.path().stem() != "broadphase";  // as the page says
        for (const std::string& key : keys) {
          EXPECT_TRUE(row.contains(key) || (!has_median && key == "median_us"))
              << entry.path() << ": " << key;
        }
        ++rows;
      }
    }
  }
  EXPECT_GT(rows, 100);
}

/// Charts name existing files.
TEST(Pages, chartsNameFilesThatExist) {
  for (const CodeBlock& block : blocksOf(Kind::flow_chart)) {
    int files = 0;
    const auto expectFile = [&](bool exists, const std::string& name) {
      EXPECT_TRUE(exists) << block.place() << ": " << name;
      ++files;
    };
    for (const std::string& name : found(block.text, "core ([a-z_]+)")) {
      const std::filesystem::recursive_directory_iterator core(kProject / "core");
      expectFile(
          std::ranges::any_of(core, [&](const auto& at) { return at.path().filename() == name + ".h"; }),
          name);
    }
    for (const std::string& name : found(block.text, "([a-z]+/[a-z_]+)\\)")) {
      expectFile(std::filesystem::exists(kProject / "demos" / (name + ".h")), name);
    }
    EXPECT_GE(files, 8);
  }
}

/// Mermaid ends a statement at the end of its line.
TEST(Pages, flowChartsHaveOneStatementALine) {
  for (const CodeBlock& block : blocksOf(Kind::flow_chart)) {
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_EQ(std::ranges::count(line, '"') % 2, 0) << block.place() << ": " << line;
      const std::size_t first = line.find_first_not_of(' ');
      EXPECT_TRUE(first == std::string::npos || std::isalpha(static_cast<unsigned char>(line[first])))
          << block.place() << ": " << line;
    }
  }
}

}  // namespace
}  // namespace octoblisk::pages
