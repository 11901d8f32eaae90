#include "report/markdown.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace octoblisk::bench {
namespace {

std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) {
    text += ' ';
    for (const char c : cell) {
      if (c == '|') text += '\\';
      text += c;
    }
    text += " |";
  }
  return text + '\n';
}

}  // namespace

std::string significant(double number, int digits) {
  if (!std::isfinite(number)) return "none";
  if (number == 0.0) return "0";
  std::ostringstream rounded;  // first round: 9.96 becomes 10, which has one digit more
  rounded << std::scientific << std::setprecision(digits - 1) << number;
  const double value = std::stod(rounded.str());
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  std::ostringstream text;
  text << std::fixed << std::setprecision(std::max(0, digits - 1 - exponent)) << value;
  std::string result = text.str();
  const std::size_t point = std::min(result.find('.'), result.size());
  const std::size_t first = result[0] == '-' ? 1 : 0;
  for (std::size_t k = point; k > first + 3; k -= 3) result.insert(k - 3, 1, ',');
  return result;
}

std::string timeText(double microseconds) {
  const auto text = [](double number) { return significant(number, number >= 99.5 ? 3 : 2); };
  if (microseconds < 999.5) return text(microseconds) + " µs";
  if (microseconds < 999.5e3) return text(microseconds / 1e3) + " ms";
  return text(microseconds / 1e6) + " s";
}

MarkdownTable::MarkdownTable(std::vector<std::string> header) : header_(std::move(header)) {
  if (header_.empty()) throw std::invalid_argument("a table needs at least one column");
}

void MarkdownTable::add(std::vector<std::string> cells) {
  if (cells.size() != header_.size()) {
    throw std::invalid_argument(std::string("a table of ") + std::to_string(header_.size()) +
                                " columns got " + std::to_string(cells.size()) + " cells");
  }
  rows_.push_back(std::move(cells));
}

std::string MarkdownTable::text() const {
  std::string text = line(header_) + '|';
  for (std::size_t k = 0; k < header_.size(); ++k) text += "---|";
  text += '\n';
  for (const auto& row : rows_) text += line(row);
  return text;
}

std::string spliced(const std::string& text, const std::string& name, const std::string& block) {
  const std::string first = std::string("<!-- ") + name + " -->\n";
  const std::string last = std::string("<!-- end of ") + name + " -->\n";
  const std::size_t begin = text.find(first);
  const std::size_t end = begin == std::string::npos ? begin : text.find(last, begin);
  if (end == std::string::npos) throw std::invalid_argument("the text has no block '" + name + "'");
  return text.substr(0, begin + first.size()) + block + text.substr(end);
}

}  // namespace octoblisk::bench
