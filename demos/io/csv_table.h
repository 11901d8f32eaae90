// Reads tables of numbers from CSV files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::demos {

struct CsvRow {
  std::size_t line = 0;        ///< in the file, counted from 1
  std::vector<double> values;  ///< finite, one per column
};

/// "FILE:LINE: message", the form of every error message about a text file.
std::string atLine(const std::filesystem::path& file, std::size_t line, const std::string& message);

/// Reads comma-separated numbers below the given header, e.g. "x,y,z", or below the longer header if one is
/// given. Ignores blanks around a value, blank lines, lines that begin with #, and a CR before the line end.
/// Throws std::runtime_error naming the file, and the line if there is one: for a missing or unreadable file,
/// a folder, a binary file, another header, a wrong number of columns, or a value that is not a finite
/// number.
std::vector<CsvRow> readCsv(const std::filesystem::path& file, const std::string& header,
                            const std::string& longer_header = {});

}  // namespace octoblisk::demos
