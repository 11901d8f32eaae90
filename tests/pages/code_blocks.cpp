#include "pages/code_blocks.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace octoblisk::pages {
namespace {

/// Whether a line outside of fences is code to Markdown, but not to codeBlocksOf.
bool isOtherCode(const std::string& line) {
  const std::size_t blanks = std::min(line.find_first_not_of(" \t"), line.size());
  const std::string rest = line.substr(blanks);
  return line.find('\t') < blanks || rest.starts_with("~~~") || (blanks > 0 && rest.starts_with("```"));
}

}  // namespace

std::vector<std::string> pagesOf(const std::filesystem::path& project) {
  std::vector<std::string> pages;
  std::filesystem::recursive_directory_iterator entry(project), end;
  for (; entry != end; ++entry) {
    const std::filesystem::path name = entry->path().filename();
    if (entry->is_directory() && (entry->path() == OCTOBLISK_BINARY_DIR || name == "build" || name == "out" ||
                                  name == "node_modules" || name == ".git")) {
      entry.disable_recursion_pending();
    } else if (name.extension() == ".md") {
      pages.push_back(std::filesystem::relative(entry->path(), project).generic_string());
    }
  }
  std::ranges::sort(pages);
  return pages;
}

std::vector<CodeBlock> codeBlocksOf(const std::filesystem::path& project, const std::string& page) {
  const std::string fence = "```", indentation = "    ";
  std::vector<CodeBlock> blocks;
  std::ifstream file(project / page);
  bool is_fenced = false, is_indented = false, is_after_blank = true;
  int number = 1;
  for (std::string line; std::getline(file, line); ++number) {
    if (line.starts_with(fence)) {
      is_indented = false;
      is_fenced = !is_fenced;
      if (is_fenced) blocks.push_back({page, number, line.substr(fence.size()), {}});
    } else if (is_fenced) {
      blocks.back().text += line + '\n';
    } else if (isOtherCode(line)) {
      throw std::invalid_argument(page + ":" + std::to_string(number) +
                                  ": code is set by ``` in the first column, or by four spaces");
    } else if (line.starts_with(indentation) && (is_indented || is_after_blank)) {
      if (!is_indented) blocks.push_back({page, number, {}, {}});
      is_indented = true;
      blocks.back().text += line.substr(indentation.size()) + '\n';
    } else {
      is_indented = false;
    }
    is_after_blank = line.empty();
  }
  if (is_fenced) throw std::invalid_argument(blocks.back().place() + ": is not closed");
  return blocks;
}

}  // namespace octoblisk::pages
