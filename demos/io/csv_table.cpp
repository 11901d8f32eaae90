#include "io/csv_table.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "io/input_file.h"
#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> result;
  for (;;) {
    const std::size_t comma = line.find(',');
    result.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return result;
    line.remove_prefix(comma + 1);
  }
}

double finiteNumber(std::string_view text, const std::filesystem::path& file, std::size_t line) {
  double value = 0.0;
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  const bool two_signs = digits.size() < text.size() && digits.starts_with('-');
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (two_signs || error != std::errc{} || stop != end || !std::isfinite(value)) {
    throw std::runtime_error(
        atLine(file, line, inQuotes(text) + " is not a finite number: correct the cell"));
  }
  return value;
}

}  // namespace

std::string atLine(const std::filesystem::path& file, std::size_t line, const std::string& message) {
  return file.string() + ":" + std::to_string(line) + ": " + message;
}

std::vector<CsvRow> readCsv(const std::filesystem::path& file, const std::string& header,
                            const std::string& longer_header) {
  std::ifstream stream = openForReading(file);
  std::string_view used_header = header;
  std::vector<std::string_view> wanted = cells(header);
  std::vector<CsvRow> rows;
  bool in_body = false;
  std::string text;
  for (std::size_t line = 1; std::getline(stream, text); ++line) {
    if (text.find('\0') != std::string::npos) {
      throw std::runtime_error(atLine(file, line, "the file is binary; it must be a CSV table of text"));
    }
    std::string_view content = text;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (line == 1 && content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
    content = trimmed(content);
    if (content.empty() || content.front() == '#') continue;
    std::vector<std::string_view> found = cells(content);
    if (!in_body) {
      if (!longer_header.empty() && found == cells(longer_header)) {
        used_header = longer_header;
        wanted = found = cells(used_header);  // of text that outlives the loop
      }
      if (found != wanted) {
        if (content.find(';') != std::string_view::npos && content.find(',') == std::string_view::npos) {
          throw std::runtime_error(
              atLine(file, line, "the columns are separated by ';'; separate them by ','"));
        }
        throw std::runtime_error(
            atLine(file, line, "the header is " + inQuotes(content) + "; it must be '" + header + "'"));
      }
      in_body = true;
      continue;
    }
    if (found.size() != wanted.size()) {
      throw std::runtime_error(atLine(file, line,
                                      std::to_string(found.size()) + " columns; '" +
                                          std::string(used_header) + "' has " +
                                          std::to_string(wanted.size())));
    }
    CsvRow row{line, {}};
    for (const std::string_view cell : found) row.values.push_back(finiteNumber(cell, file, line));
    rows.push_back(std::move(row));
  }
  if (!in_body)
    throw std::runtime_error(atLine(file, 1, "the file is empty; it must begin with '" + header + "'"));
  return rows;
}

}  // namespace octoblisk::demos
