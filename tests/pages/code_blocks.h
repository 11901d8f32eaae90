// The blocks of code in the project's Markdown pages.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::pages {

struct CodeBlock {
  std::string page;      ///< relative to the project's folder
  int line = 0;          ///< the first line, counted from 1
  std::string language;  ///< named by the fence; empty if the block is indented
  std::string text;      ///< without fence and indentation; every line ends with a newline

  std::string place() const { return page + ":" + std::to_string(line); }
};

/// All pages in the project's root and folders, except build output and third-party files.
std::vector<std::string> pagesOf(const std::filesystem::path& project);

/// The code blocks in order. Throws std::invalid_argument with page and line if a fence is not closed, is
/// indented or uses tildes, or if a line begins with a tab.
std::vector<CodeBlock> codeBlocksOf(const std::filesystem::path& project, const std::string& page);

}  // namespace octoblisk::pages
