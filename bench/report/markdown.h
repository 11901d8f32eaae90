// Numbers and tables as Markdown.
#pragma once

#include <string>
#include <vector>

namespace octoblisk::bench {

/// To so many significant digits, without an exponent: "0.42", "1,300".
std::string significant(double number, int digits = 2);

/// "3.4 µs", "320 ms": to two digits, or three from 100 on.
std::string timeText(double microseconds);

class MarkdownTable {
 public:
  /// Throws std::invalid_argument for no columns.
  explicit MarkdownTable(std::vector<std::string> header);

  /// Throws std::invalid_argument for another number of cells than columns.
  void add(std::vector<std::string> cells);

  bool empty() const { return rows_.empty(); }

  /// Ends with a newline. Bars in cells are escaped.
  std::string text() const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

/// The text with what is between the lines <!-- NAME --> and <!-- end of NAME --> replaced. Throws
/// std::invalid_argument where it has not both lines.
std::string spliced(const std::string& text, const std::string& name, const std::string& block);

/// Whether a ratio of times to ours, or of bytes, is below 1 when it is rounded to two digits.
constexpr bool isFaster(double ratio) { return ratio < 0.995; }

}  // namespace octoblisk::bench
