// Shared by the tests of pages: blocks by kind, text search and replacement, and shell scripts.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "pages/code_blocks.h"

namespace octoblisk::pages {

inline const std::filesystem::path kProject = OCTOBLISK_SOURCE_DIR;

enum class Kind {
  cpp,
  cmake,
  flow_chart,
  dev_verbs,
  presets,
  libraries,
  benchmark,
  row,
  octoblisk,
  story,
  tutorial,
  study
};

/// The beginnings of blocks without a language.
inline const std::vector<std::pair<std::string, Kind>> kBeginnings = {
    {"./dev ", Kind::dev_verbs},
    {"cmake --preset ", Kind::presets},
    {"cmake -S ", Kind::libraries},
    {"build/bench/bin/", Kind::benchmark},
    {"{\"task\", ", Kind::row},
    {"octoblisk check …", Kind::study},
    {"octoblisk path --out path.csv", Kind::story},
    {"octoblisk ", Kind::octoblisk}};
inline const std::map<std::string, Kind> kLanguages = {
    {"cpp", Kind::cpp}, {"cmake", Kind::cmake}, {"mermaid", Kind::flow_chart}};

/// The pages whose calls of octoblisk run one after another in one folder.
inline bool isTutorial(const std::string& page) {
  return page == "docs/grinding.md" || page == "docs/rotor67.md";
}

inline std::optional<Kind> kindOf(const CodeBlock& block) {
  if (const auto known = kLanguages.find(block.language); known != kLanguages.end()) return known->second;
  if (!block.language.empty()) return std::nullopt;
  if (isTutorial(block.page) && block.text.starts_with("octoblisk ")) return Kind::tutorial;
  for (const auto& [beginning, kind] : kBeginnings) {
    if (block.text.starts_with(beginning)) return kind;
  }
  return std::nullopt;
}

inline std::vector<CodeBlock> allBlocks() {
  std::vector<CodeBlock> all;
  for (const std::string& page : pagesOf(kProject)) {
    for (CodeBlock& block : codeBlocksOf(kProject, page)) all.push_back(std::move(block));
  }
  return all;
}

/// The blocks of a kind. Fails if it finds none.
inline std::vector<CodeBlock> blocksOf(Kind kind) {
  std::vector<CodeBlock> blocks = allBlocks();
  std::erase_if(blocks, [&](const CodeBlock& block) { return kindOf(block) != kind; });
  EXPECT_FALSE(blocks.empty()) << "this test checks no blocks";
  return blocks;
}

/// All matches of the expression's first group.
inline std::vector<std::string> found(const std::string& text, const std::string& expression) {
  const std::regex searched(expression);
  std::vector<std::string> all;
  for (std::sregex_iterator at(text.begin(), text.end(), searched), end; at != end; ++at) {
    all.push_back((*at)[1]);
  }
  return all;
}

/// Replaces every occurrence of `part`. Fails if it finds none.
inline std::string replaced(std::string text, const std::string& part, const std::string& by) {
  EXPECT_THAT(text, ::testing::HasSubstr(part));
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += by.size()) {
    text.replace(at, part.size(), by);
  }
  return text;
}

/// The page without code in blocks and sentences, and with every run of blanks replaced by one space.
inline std::string proseOf(const std::string& text) {
  std::string prose;
  bool is_code = false, is_blank = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_mark = text[i] == '`';
    is_code ^= is_mark && (i == 0 || text[i - 1] != '`');
    if (is_mark || is_code) continue;
    const bool was_blank = is_blank;
    is_blank = text[i] == ' ' || text[i] == '\n';
    if (!is_blank) prose += text[i];
    if (is_blank && !was_blank) prose += ' ';
  }
  return prose;
}

/// Runs shell lines in a folder. `octoblisk` is the command of this build.
inline demos::Outcome runScript(const demos::ScratchFolder& folder, const std::string& script) {
  const std::string path = std::filesystem::path(OCTOBLISK_COMMAND).parent_path().string();
  // Lets mpirun run for any user and on any number of processors.
  const std::string mpi =
      "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
      "OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl_vader_single_copy_mechanism=none "
      "OMPI_MCA_btl=self,vader\n";
  folder.write("script.sh", mpi + "export PATH='" + path + "':\"$PATH\" LSAN_OPTIONS='suppressions=" +
                                OCTOBLISK_LEAK_SUPPRESSIONS ":print_suppressions=0'\n" + script);
  const std::string command =
      "cd '" + folder.path().string() + "' && sh -eu script.sh >stdout.txt 2>stderr.txt </dev/null";
  return demos::outcomeOf(std::system(command.c_str()), folder.path());
}

}  // namespace octoblisk::pages
