// Numbers and tables as Markdown.
#pragma once

#include <string>
#include <vector>

namespace octoblisk::bench {

/// The number with `digits` significant digits and no exponent: "0.42", "1,300".
std::string significant(double number, int digits = 2);

/// "3.4 µs", "320 ms": two digits, or three from 100 on.
std::string timeText(double microseconds);

class MarkdownTable {
 public:
  /// Throws std::invalid_argument if it has no columns.
  explicit MarkdownTable(std::vector<std::string> header);

  /// Throws std::invalid_argument if the number of cells differs from the number of columns.
  void add(std::vector<std::string> cells);

  bool empty() const { return rows_.empty(); }

  /// Ends with a newline. Bars in cells are escaped.
  std::string text() const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

/// Replaces the text between the lines <!-- NAME --> and <!-- end of NAME -->. Throws std::invalid_argument
/// if either line is missing.
std::string spliced(const std::string& text, const std::string& name, const std::string& block);

/// Whether a ratio to OctoBlisk's time or bytes is below 1 when rounded to two digits.
constexpr bool isFaster(double ratio) { return ratio < 0.995; }

}  // namespace octoblisk::bench
