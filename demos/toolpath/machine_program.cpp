#include "toolpath/machine_program.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <string>

#include "io/input_file.h"

namespace octoblisk::demos {
namespace {

struct Signature {
  std::string_view language;
  const char* line;  ///< a line that no toolpath contains
};

constexpr std::array<Signature, 4> kSignatures = {
    {{"a Heidenhain program", R"(\s*\d+\s+BEGIN PGM .*)"},
     {"a KUKA KRL program", R"(\s*(&ACCESS|DEF |DEFDAT |S?(PTP|LIN)(_REL)?\s*\{).*)"},
     {"an ABB RAPID program", R"(\s*(MODULE |PROC |Move(L|J|AbsJ|C)\b).*)"},
     {"a FANUC TP program", R"(\s*(/PROG |\d+:\s*[JL] P\[).*)"}}};

/// A block of G-code: an optional number, then a word of an address and a number.
constexpr const char* kBlock = R"(\s*/?\s*(N\d+\s*)?(G\d+|M\d+|[XYZABCIJKFST][-+]?\.?\d)([^/]*))";

}  // namespace

std::optional<std::string_view> machineProgramIn(const std::filesystem::path& file) {
  constexpr std::size_t kLines = 200, kLongest = 200;  // std::regex recurses over a line
  std::array<std::regex, kSignatures.size()> signatures;
  for (std::size_t i = 0; i < kSignatures.size(); ++i)
    signatures[i] = std::regex(kSignatures[i].line, std::regex::icase);
  const std::regex block(kBlock, std::regex::icase);
  std::ifstream stream = openForReading(file);
  std::size_t with_words = 0, blocks = 0;
  std::string line;
  for (std::size_t number = 0; number < kLines && std::getline(stream, line); ++number) {
    line.resize(std::min(line.size(), kLongest));
    const auto isLetter = [](unsigned char c) { return std::isalpha(c) != 0; };
    if (std::ranges::none_of(line, isLetter)) continue;
    ++with_words;
    for (std::size_t i = 0; i < kSignatures.size(); ++i) {
      if (std::regex_match(line, signatures[i])) return kSignatures[i].language;
    }
    blocks += std::regex_match(line, block);
  }
  if (2 * blocks > with_words) return "G-code";
  return std::nullopt;
}

}  // namespace octoblisk::demos
