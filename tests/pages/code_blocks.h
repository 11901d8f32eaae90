// The blocks of code in the project's Markdown pages.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::pages {

struct CodeBlock {
  std::string page;      ///< relative to the project's folder
  int line = 0;          ///< its first, counted from 1
  std::string language;  ///< that a fence names; empty where the block is indented
  std::string text;      ///< without fence and indentation, every line ended

  std::string place() const { return page + ":" + std::to_string(line); }
};

/// All pages of the project: of its root and of the folders in it, but for what is built or not its own.
std::vector<std::string> pagesOf(const std::filesystem::path& project);

/// In order. Throws std::invalid_argument, with page and line, on a fence that is not closed, that is
/// indented or of tildes, and on a line behind a tab.
std::vector<CodeBlock> codeBlocksOf(const std::filesystem::path& project, const std::string& page);

}  // namespace octoblisk::pages
