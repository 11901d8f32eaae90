// Reads the words, numbers and lines of a text in memory.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "io/quoted_text.h"

namespace octoblisk::demos {

/// Reads a text by words and lines. Its errors are std::runtime_error, "FILE:LINE: message".
class TextReader {
 public:
  TextReader(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool atEnd() const { return rest().empty(); }
  std::size_t position() const { return position_; }

  /// The next word of this line; empty at the end of the line.
  std::string_view word() {
    position_ += std::min(rest().find_first_not_of(" \t\r\v\f"), rest().size());
    const std::size_t length = std::min(rest().find_first_of(" \t\r\v\f\n"), rest().size());
    const std::string_view result = rest().substr(0, length);
    position_ += length;
    return result;
  }

  /// Goes to the beginning of the next line.
  void nextLine() {
    const std::size_t line_end = rest().find('\n');
    position_ = line_end == std::string_view::npos ? text_.size() : position_ + line_end + 1;
    ++line_;
  }

  /// The next word of this line as a number. NaN and infinity pass: the mesh reader finds them.
  double number() {
    const std::string_view found = word();
    if (found.empty()) fail("a number is missing");
    const std::string_view digits = found.front() == '+' ? found.substr(1) : found;
    double value = 0.0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::invalid_argument || stop != digits.data() + digits.size()) {
      fail(inQuotes(found) + " is not a number");
    }
    return value;
  }

  /// The line of the next word, counted from 1.
  std::size_t line() const { return line_; }

  [[noreturn]] void fail(const std::string& message) const { failAt(line_, message); }
  [[noreturn]] void failAt(std::size_t line, const std::string& message) const {
    throw std::runtime_error(file_ + ":" + std::to_string(line) + ": " + message);
  }

 private:
  std::string_view rest() const { return text_.substr(position_); }

  std::string_view text_;
  std::string file_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
};

}  // namespace octoblisk::demos
