// Checks the text of pages: the README's length, links, and the terms of the glossary.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "pages/page_test.h"

namespace octoblisk::pages {
namespace {

using demos::contentOf;

const std::string kGlossary = "docs/glossary.md";

TEST(Pages, theReadmeIsShort) {
  const std::string readme = contentOf(kProject / "README.md");
  EXPECT_LE(std::ranges::count(readme, '\n'), 130);
}

/// The README's few rows of numbers are written by hand.
TEST(Pages, timesOfTheReadmeAreThoseOfTheResults) {
  const std::string results = contentOf(kProject / "bench/results/README.md");
  const auto times = found(contentOf(kProject / "README.md"), "\\| ([0-9.]+ (µs|ms)) \\|");
  EXPECT_EQ(times.size(), 5u);
  for (const std::string& time : times) EXPECT_THAT(results, ::testing::HasSubstr("| " + time)) << time;
}

/// The anchors of a page's headings, as GitHub names them.
std::set<std::string> anchorsOf(const std::string& page) {
  std::set<std::string> anchors;
  std::istringstream lines(page);
  bool is_code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) is_code = !is_code;
    if (is_code || !line.starts_with('#')) continue;
    std::string anchor;
    for (const char letter : line.substr(line.find(' ') + 1)) {
      if (letter == ' ' || letter == '-') anchor += '-';
      if (std::isalnum(static_cast<unsigned char>(letter)) || letter == '_') {
        anchor += char(std::tolower(static_cast<unsigned char>(letter)));
      }
    }
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(Pages, linksLeadSomewhere) {
  int links = 0;
  for (const std::string& page : pagesOf(kProject)) {
    for (const std::string& link : found(proseOf(contentOf(kProject / page)), R"(\]\(([^)]+)\))")) {
      if (link.starts_with("http")) continue;
      const std::size_t hash = std::min(link.find('#'), link.size());
      const std::filesystem::path target =
          hash == 0 ? kProject / page : (kProject / page).parent_path() / link.substr(0, hash);
      EXPECT_TRUE(std::filesystem::exists(target)) << page << ": " << link;
      ++links;
      if (hash == link.size() || !std::filesystem::is_regular_file(target)) continue;
      EXPECT_TRUE(anchorsOf(contentOf(target)).contains(link.substr(hash + 1))) << page << ": " << link;
    }
  }
  EXPECT_GE(links, 100);
}

/// The cells of the glossary's rows.
std::vector<std::vector<std::string>> glossary() {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& row : found(contentOf(kProject / kGlossary), "\n\\| ([^-\n][^\n]*)\\|(?=\n)")) {
    rows.push_back(found("| " + row + "|", "\\| ([^|]*) ?(?=\\|)"));
  }
  if (!rows.empty()) rows.erase(rows.begin());  // the head
  return rows;
}

TEST(Pages, keepToTheGlossary) {
  const auto rows = glossary();
  ASSERT_GE(rows.size(), 20u);
  EXPECT_LE(rows.size(), 40u);
  std::vector<std::filesystem::path> texts;
  for (const std::string& page : pagesOf(kProject)) {
    if (page != kGlossary) texts.push_back(kProject / page);
  }
  for (const auto& entry : std::filesystem::directory_iterator(kProject / "demos/command_line/help")) {
    texts.push_back(entry.path());
  }
  int words = 0;
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 3u) << row.front();
    for (const std::string& word : found(row[2] + ',', "([^ ,][^,]*[^ ,]) *,")) {
      ++words;
      const std::regex whole("\\b" + word + "\\b", std::regex::icase);
      for (const auto& text : texts) {
        const std::string prose = proseOf(contentOf(text));
        std::smatch match;
        EXPECT_FALSE(std::regex_search(prose, match, whole))
            << text << ": \"" << word << "\" instead of \"" << row[0] << "\": ..."
            << match.prefix().str().substr(
                   std::size_t(std::max<std::ptrdiff_t>(0, match.prefix().length() - 40)));
      }
    }
  }
  EXPECT_GE(words, 10);
}

}  // namespace
}  // namespace octoblisk::pages
