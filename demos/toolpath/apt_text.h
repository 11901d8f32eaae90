// The statements of an APT file, one by one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace octoblisk::demos {

/// "GOTO/1,2,3": a word and what follows it.
struct AptStatement {
  std::size_t line = 0;                ///< where it begins, counted from 1
  std::size_t last_line = 0;           ///< where it ends
  std::string word;                    ///< in capitals, without blanks
  std::vector<std::string> arguments;  ///< in capitals, without blanks; of free text (PARTNO) none
};

/// Reads statements: comments ($$ to the end of the line) and blank lines are passed over, a single $ goes on
/// in the next line, what stands behind it counts for nothing. Blanks and case count for nothing either. The
/// rest of a line that begins with PARTNO, PPRINT, REMARK, INSERT, LETTER, TPRINT or DISPLY is free text.
class AptText {
 public:
  /// Throws std::runtime_error naming the file where it cannot be read.
  explicit AptText(std::filesystem::path file);

  /// The next statement; false at the end of the file.
  /// Throws std::runtime_error naming file and line: binary bytes, a statement that goes on beyond the end of
  /// the file, one that does not begin with a word, or an assignment or label (=, parentheses).
  bool next(AptStatement& statement);

  /// Throws std::runtime_error, "FILE:LINE: message".
  [[noreturn]] void fail(std::size_t line, const std::string& message) const;

  /// An argument as a finite number; fails where there is none.
  double number(const AptStatement& statement, std::size_t argument) const;

 private:
  bool readLine(std::string& text);

  std::filesystem::path file_;
  std::ifstream stream_;
  std::size_t line_ = 0;
};

}  // namespace octoblisk::demos
