// Reads the statements of an APT file one at a time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace octoblisk::demos {

/// "GOTO/1,2,3": a word and its arguments.
struct AptStatement {
  std::size_t line = 0;                ///< first line, counted from 1
  std::size_t last_line = 0;           ///< last line
  std::string word;                    ///< upper case, without blanks
  std::vector<std::string> arguments;  ///< upper case, without blanks; none for free text (PARTNO)
};

/// Skips comments ($$ to the end of the line) and blank lines. A single $ continues the statement on the next
/// line; the rest of its line is ignored. Blanks and case are ignored too. The rest of a line that begins
/// with PARTNO, PPRINT, REMARK, INSERT, LETTER, TPRINT or DISPLY is free text.
class AptText {
 public:
  /// Throws std::runtime_error naming the file if it cannot be read.
  explicit AptText(std::filesystem::path file);

  /// Reads the next statement; false at the end of the file. Throws std::runtime_error naming file and line
  /// for binary bytes, a statement that continues beyond the end of the file, a statement that does not begin
  /// with a word, and an assignment or label (=, parentheses).
  bool next(AptStatement& statement);

  /// Throws std::runtime_error, "FILE:LINE: message".
  [[noreturn]] void fail(std::size_t line, const std::string& message) const;

  /// An argument as a finite number; fails if it is missing or not a number.
  double number(const AptStatement& statement, std::size_t argument) const;

 private:
  bool readLine(std::string& text);

  std::filesystem::path file_;
  std::ifstream stream_;
  std::size_t line_ = 0;
};

}  // namespace octoblisk::demos
