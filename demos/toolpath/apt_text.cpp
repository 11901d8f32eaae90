#include "toolpath/apt_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "io/csv_table.h"
#include "io/input_file.h"
#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

bool isBlank(char letter) { return std::isspace(static_cast<unsigned char>(letter)) != 0; }

/// Upper case, without blanks.
std::string packed(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    if (!isBlank(letter)) result += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  return result;
}

/// The word in front of free text; empty if the line has none.
std::string wordBeforeFreeText(std::string_view line) {
  constexpr std::array<std::string_view, 7> kWords = {"PARTNO", "PPRINT", "REMARK", "INSERT",
                                                      "LETTER", "TPRINT", "DISPLY"};
  const std::string start = packed(line.substr(0, line.find('/'))).substr(0, 6);
  const auto word = std::find(kWords.begin(), kWords.end(), start);
  return word == kWords.end() ? std::string() : std::string(*word);
}

bool isWord(std::string_view text) {
  const auto belongs = [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' || letter == '_' ||
           letter == '.' || letter == ',';
  };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         std::all_of(text.begin(), text.end(), belongs);
}

}  // namespace

AptText::AptText(std::filesystem::path file) : file_(std::move(file)), stream_(openForReading(file_)) {}

void AptText::fail(std::size_t line, const std::string& message) const {
  throw std::runtime_error(atLine(file_, line, message));
}

bool AptText::readLine(std::string& text) {
  if (!std::getline(stream_, text)) return false;
  ++line_;
  if (text.find('\0') != std::string::npos) fail(line_, "the file is binary; a CL file is text");
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (line_ == 1 && text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return true;
}

bool AptText::next(AptStatement& statement) {
  std::string text, whole;
  bool goes_on = false;
  while (readLine(text)) {
    if (!goes_on) {
      statement = {line_, line_, wordBeforeFreeText(text), {}};
      if (!statement.word.empty()) return true;
    }
    const std::size_t dollar = text.find('$');
    const bool is_comment = dollar != std::string::npos && text.substr(dollar, 2) == "$$";
    whole += packed(text.substr(0, dollar));
    const bool only_comment = is_comment && packed(text.substr(0, dollar)).empty();
    if (goes_on && only_comment) continue;  // a comment inside a statement
    goes_on = dollar != std::string::npos && !is_comment;
    if (goes_on) continue;
    if (!whole.empty()) break;
  }
  if (goes_on)
    fail(statement.line, "the statement continues ($) beyond the end of the file: the file is truncated");
  if (whole.empty()) return false;
  statement.last_line = line_;

  const std::size_t slash = whole.find('/');
  statement.word = whole.substr(0, slash);
  if (whole.find('=') != std::string::npos || statement.word.find_first_of("()") != std::string::npos) {
    fail(statement.line, inQuotes(whole) +
                             " is APT source, a definition or a label: give a CL file, the output of "
                             "the APT processor");
  }
  if (!isWord(statement.word))
    fail(statement.line, inQuotes(whole) + " is not an APT statement: give a CL file in APT");
  if (slash == std::string::npos) return true;
  std::string_view rest = std::string_view(whole).substr(slash + 1);
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    statement.arguments.emplace_back(rest.substr(0, comma));
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    if (comma != std::string_view::npos && rest.empty()) statement.arguments.emplace_back();
  }
  return true;
}

double AptText::number(const AptStatement& statement, std::size_t argument) const {
  const std::string& text = statement.arguments.at(argument);
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  const char* const end = text.data() + text.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data() + sign, end, value);
  const bool two_signs = sign == 1 && text.substr(1).starts_with('-');
  if (two_signs || error != std::errc{} || stop != end || !std::isfinite(value)) {
    fail(statement.line, statement.word + ": " + inQuotes(text) + " is not a finite number");
  }
  return value;
}

}  // namespace octoblisk::demos
