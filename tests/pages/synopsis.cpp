#include "pages/synopsis.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

namespace octoblisk::pages {
namespace {

constexpr std::string_view kEllipsis = "…";

/// The alternatives of a word, `a|b`, or of a group, `a B | c D`.
std::vector<std::string> alternativesOf(const std::string& text, const std::string& bar) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(bar, begin)) != std::string::npos; begin = end + bar.size()) {
    parts.push_back(text.substr(begin, end - begin));
  }
  parts.push_back(text.substr(begin));
  std::erase(parts, kEllipsis);  // repetition
  return parts;
}

/// The terms: words, and whole groups in brackets.
std::vector<std::string> termsOf(const std::string& text) {
  std::vector<std::string> terms;
  int depth = 0;
  bool is_inside = false;
  for (const char letter : text) {
    if (depth == 0 && std::isspace(static_cast<unsigned char>(letter))) {
      is_inside = false;
      continue;
    }
    if (!is_inside) terms.emplace_back();
    is_inside = true;
    terms.back() += letter;
    depth += (letter == '[') - (letter == ']');
  }
  if (depth != 0) throw std::invalid_argument("brackets that do not match: " + text);
  return terms;
}

bool isPlaceholder(const std::string& word) {
  const auto is_capital = [](unsigned char letter) { return std::isupper(letter) || letter == '/'; };
  const std::string stem = word.substr(0, word.find('.'));
  return word == kEllipsis || word.find(',') != std::string::npos || std::ranges::all_of(stem, is_capital);
}

/// Makes the call for one choice of alternatives.
class Call {
 public:
  Call(const std::vector<Placeholder>& placeholders, std::size_t choice, bool has_options)
      : placeholders_(placeholders), choice_(choice), has_options_(has_options) {}

  std::string of(const std::string& text) {
    for (const std::string& term : termsOf(text)) {
      if (term.starts_with('[')) {
        if (has_options_) of(chosen(term.substr(1, term.size() - 2), " | "));
      } else {
        add(chosen(term, "|"));
      }
    }
    return call_;
  }

  std::size_t choices() const { return choices_; }

 private:
  std::string chosen(const std::string& text, const std::string& bar) {
    const std::vector<std::string> alternatives = alternativesOf(text, bar);
    choices_ = std::max(choices_, alternatives.size());
    return alternatives[choice_ % alternatives.size()];
  }

  void add(const std::string& word) {
    call_ += (call_.empty() ? "" : " ") + (isPlaceholder(word) ? valueOf(word) : word);
    option_ = word;
  }

  std::string valueOf(const std::string& word) const {
    const auto fits = [&](const Placeholder& placeholder) {
      return placeholder.word == word && (placeholder.option.empty() || placeholder.option == option_);
    };
    const auto found = std::ranges::find_if(placeholders_, fits);
    if (found == placeholders_.end())
      throw std::invalid_argument("nothing is known of " + option_ + ' ' + word);
    return found->value;
  }

  const std::vector<Placeholder>& placeholders_;
  std::size_t choice_, choices_ = 1;
  bool has_options_;
  std::string call_, option_;
};

}  // namespace

std::vector<std::string> synopsesOf(const std::string& block, const std::string& command) {
  std::vector<std::string> synopses;
  std::istringstream lines(block);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(command + ' ') && !synopses.empty()) {
      synopses.back() += ' ' + line;
      continue;
    }
    const std::string next = ", " + command + ' ';
    for (std::size_t comma; (comma = line.find(next)) != std::string::npos; line.erase(0, comma + 2)) {
      synopses.push_back(line.substr(0, comma));
    }
    synopses.push_back(line);
  }
  return synopses;
}

std::vector<std::string> fullCalls(const std::string& synopsis,
                                   const std::vector<Placeholder>& placeholders) {
  std::vector<std::string> calls;
  for (std::size_t choice = 0, choices = 1; choice < choices; ++choice) {
    Call call(placeholders, choice, true);
    calls.push_back(call.of(synopsis));
    choices = std::max(choices, call.choices());
  }
  return calls;
}

std::string leastCall(const std::string& synopsis, const std::vector<Placeholder>& placeholders) {
  return Call(placeholders, 0, false).of(synopsis);
}

}  // namespace octoblisk::pages
