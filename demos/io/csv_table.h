// Tables of numbers in CSV files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::demos {

struct CsvRow {
  std::size_t line = 0;        ///< in the file, counted from 1
  std::vector<double> values;  ///< finite, one a column
};

/// "FILE:LINE: message", as every complaint about a text file reads.
std::string atLine(const std::filesystem::path& file, std::size_t line, const std::string& message);

/// Reads comma-separated numbers below the given header line, e.g. "x,y,z", or below the longer one where one
/// is given. Blanks round a value, blank lines, lines that begin with # and a CR before the line end are
/// ignored. Throws std::runtime_error naming the file, and the line where there is one: missing or unreadable
/// file, a folder, a binary file, another header, another number of columns, a value that is no finite
/// number.
std::vector<CsvRow> readCsv(const std::filesystem::path& file, const std::string& header,
                            const std::string& longer_header = {});

}  // namespace octoblisk::demos
