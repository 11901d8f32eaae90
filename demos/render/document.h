// A report of sections with paragraphs, tables and figures, as CSV, Markdown and HTML.
//
//   const Section section{.title = "Nodes", .paragraphs = {"…"}, .tables = {{"nodes", "…", {"k", "nodes"},
//   rows}}}; writeReport({.title = "The paper, rerun", .sections = {section}}, "out");
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::demos {

// All text is plain UTF-8; characters with a meaning in CSV, Markdown or HTML are escaped on output.

struct Table {
  std::string name;  ///< file name without ".csv"
  std::string caption{};
  std::vector<std::string> columns{};
  std::vector<std::vector<std::string>> rows{};  ///< one cell per column
};

struct Figure {
  std::string file;  ///< .svg or .png, in the report's folder
  std::string caption;
};

struct Section {
  std::string title;
  std::vector<std::string> paragraphs{};
  std::vector<Table> tables{};
  std::vector<Figure> figures{};
};

struct Document {
  std::string title;
  std::vector<std::string> paragraphs{};  ///< before the sections
  std::vector<Section> sections{};
};

/// `folder`/NAME.csv by RFC 4180 with LF line ends: the columns, then the rows. Throws std::invalid_argument
/// naming a table with a row of the wrong number of cells, and std::runtime_error naming a file that cannot
/// be written.
void writeCsv(const Table& table, const std::filesystem::path& folder);

/// The document as Markdown with GitHub's tables and links to the figures. Throws std::invalid_argument as
/// above.
std::string markdownOf(const Document& document);

/// The document as one HTML page that needs no other file: it contains the figures, which are read from the
/// folder. Throws as writeCsv, and std::runtime_error naming a figure that cannot be read or is neither .svg
/// nor .png.
std::string htmlOf(const Document& document, const std::filesystem::path& folder);

/// Writes every table as CSV, report.md and report.html to a folder that has the figures. Throws as above.
void writeReport(const Document& document, const std::filesystem::path& folder);

}  // namespace octoblisk::demos
