#include "render/document.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "io/base64.h"
#include "io/input_file.h"
#include "io/markup_text.h"
#include "io/new_file.h"

namespace octoblisk::demos {
namespace {

void requireRectangular(const Table& table) {
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.rows[row].size() == table.columns.size()) continue;
    throw std::invalid_argument("table " + table.name + ": row " + std::to_string(row) + " has " +
                                std::to_string(table.rows[row].size()) + " cells for " +
                                std::to_string(table.columns.size()) + " columns");
  }
}

/// True if all cells of a column begin like numbers: numbers are aligned right, text is aligned left.
bool isNumeric(const Table& table, std::size_t column) {
  const auto isNumber = [&](const auto& row) {
    const std::string& cell = row[column];
    const std::size_t digit = cell.find_first_not_of("+-");
    return cell.empty() || cell == "–" ||
           (digit != std::string::npos && std::isdigit(static_cast<unsigned char>(cell[digit])) != 0);
  };
  return std::ranges::all_of(table.rows, isNumber);
}

std::string csvCell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csvLine(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    line += csvCell(cells[i]);
  }
  return line + '\n';
}

/// Escapes text within a line for Markdown.
std::string markdownText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("\\`*_[]<&|~").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c == '\n' || c == '\r' ? ' ' : c;
  }
  return escaped;
}

/// The same at the beginning of a line, where it must not become a title, list or quotation.
std::string markdownParagraph(const std::string& text) {
  std::string escaped = markdownText(text);
  const std::size_t digits = escaped.find_first_not_of("0123456789");
  if (digits == std::string::npos) return escaped;
  const bool begins_list = digits > 0 && (escaped[digits] == '.' || escaped[digits] == ')');
  const bool begins_block =
      digits == 0 && std::string_view("#+->=").find(escaped[0]) != std::string_view::npos;
  if (begins_list || begins_block) escaped.insert(digits, 1, '\\');
  return escaped;
}

std::string markdownRow(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += ' ' + markdownText(cell) + " |";
  return line + '\n';
}

std::string markdownTable(const Table& table) {
  requireRectangular(table);
  std::string text = "**" + markdownText(table.caption) + "**\n\n" + markdownRow(table.columns);
  text += '|';
  for (std::size_t i = 0; i < table.columns.size(); ++i) text += isNumeric(table, i) ? " ---: |" : " --- |";
  text += '\n';
  for (const auto& row : table.rows) text += markdownRow(row);
  return text + '\n';
}

/// The target of a link, for any file name.
std::string percentEncoded(const std::string& file) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : file) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || std::string_view("-._~/").find(c) != std::string_view::npos) {
      encoded += c;
    } else {
      encoded += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return encoded;
}

std::string element(const std::string& tag, const std::string& text) {
  return '<' + tag + '>' + markupText(text) + "</" + tag + ">";
}

std::string htmlTable(const Table& table) {
  requireRectangular(table);
  // The caption is outside the table: inside, it would be as narrow as the table, or scroll away.
  std::string text = "<figure class=\"table\">" + element("figcaption", table.caption) +
                     "<div class=\"wide\"><table>\n<thead><tr>";
  std::vector<std::string> cell_start;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    cell_start.push_back(isNumeric(table, i) ? " class=\"n\">" : ">");
    text += "<th" + cell_start.back() + markupText(table.columns[i]) + "</th>";
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) text += "<td" + cell_start[i] + markupText(row[i]) + "</td>";
    text += "</tr>\n";
  }
  return text + "</tbody></table></div></figure>\n";
}

std::string htmlFigure(const Figure& figure, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / figure.file;
  const std::string kind = file.extension() == ".svg" ? "svg+xml" : file.extension() == ".png" ? "png" : "";
  if (kind.empty()) throw std::runtime_error(file.string() + ": a figure must be .svg or .png");
  std::ifstream stream = openForReading(file);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return "<figure><img alt=\"" + markupText(figure.caption) + "\" src=\"data:image/" + kind + ";base64," +
         base64(bytes) + "\">" + element("figcaption", figure.caption) + "</figure>\n";
}

/// Wide tables scroll under their first column; figures are placed side by side if there is room.
constexpr std::string_view kStyle =
    "body{font:15px/1.45 system-ui,\"DejaVu Sans\",sans-serif;max-width:72rem;margin:1.5rem auto;padding:0 "
    "1rem;color:#21262e}h1{font-size:1.5rem}h2{font-size:1.15rem}a{color:#0a5c9e}"
    "a:focus-visible{outline:3px solid #0a5c9e}"
    "nav a{display:inline-block;margin-right:1.2rem}figure{margin:1rem 0}figcaption{color:#505a68}"
    ".wide{overflow-x:auto}table{border-collapse:collapse;font-size:.85rem}"
    ".table figcaption{font-weight:bold;color:inherit;font-size:.9rem;padding:.3rem 0}"
    "th,td{border:1px solid #c8ced6;padding:.2rem .5rem;text-align:left;vertical-align:top}"
    "th{background:#eef1f4}td{background:#fff}td.n,th.n{text-align:right}td.n{white-space:nowrap}"
    "th:first-child:not(.n),td:first-child:not(.n){position:sticky;left:0;min-width:7.5rem;max-width:45vw}"
    ".figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(24rem,100%),1fr));gap:0 1rem}"
    "img{max-width:100%}";

/// Links to the sections.
std::string htmlContents(const std::vector<Section>& sections) {
  std::string text = "<nav>";
  for (std::size_t i = 0; i < sections.size(); ++i) {
    text += "<a href=\"#s" + std::to_string(i + 1) + "\">" + markupText(sections[i].title) + "</a>\n";
  }
  return text + "</nav>\n";
}

std::string htmlSection(const Section& section, std::size_t number, const std::filesystem::path& folder) {
  std::string text = "<h2 id=\"s" + std::to_string(number) + "\">" + markupText(section.title) + "</h2>\n";
  for (const std::string& paragraph : section.paragraphs) text += element("p", paragraph) + "\n";
  for (const Table& table : section.tables) text += htmlTable(table);
  if (section.figures.empty()) return text;
  text += "<div class=\"figures\">\n";
  for (const Figure& figure : section.figures) text += htmlFigure(figure, folder);
  return text + "</div>\n";
}

}  // namespace

void writeCsv(const Table& table, const std::filesystem::path& folder) {
  requireRectangular(table);
  std::string text = csvLine(table.columns);
  for (const auto& row : table.rows) text += csvLine(row);
  writeFile(folder / (table.name + ".csv"), text);
}

std::string markdownOf(const Document& document) {
  std::string text = "# " + markdownText(document.title) + "\n\n";
  for (const std::string& paragraph : document.paragraphs) text += markdownParagraph(paragraph) + "\n\n";
  for (const Section& section : document.sections) {
    text += "## " + markdownText(section.title) + "\n\n";
    for (const std::string& paragraph : section.paragraphs) text += markdownParagraph(paragraph) + "\n\n";
    for (const Table& table : section.tables) text += markdownTable(table);
    for (const Figure& figure : section.figures) {
      const std::string caption = markdownText(figure.caption);
      text += "![" + caption + "](" + percentEncoded(figure.file) + ")\n\n*" + caption + "*\n\n";
    }
  }
  return text;
}

std::string htmlOf(const Document& document, const std::filesystem::path& folder) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\">" +
      element("title", document.title) + "<style>" + std::string(kStyle) + "</style></head>\n<body>\n" +
      element("h1", document.title) + "\n";
  for (const std::string& paragraph : document.paragraphs) text += element("p", paragraph) + "\n";
  text += htmlContents(document.sections);
  for (std::size_t i = 0; i < document.sections.size(); ++i) {
    text += htmlSection(document.sections[i], i + 1, folder);
  }
  return text + "</body>\n</html>\n";
}

void writeReport(const Document& document, const std::filesystem::path& folder) {
  for (const Section& section : document.sections) {
    for (const Table& table : section.tables) writeCsv(table, folder);
  }
  writeFile(folder / "report.md", markdownOf(document));
  writeFile(folder / "report.html", htmlOf(document, folder));
}

}  // namespace octoblisk::demos
