#include "command_line/subcommand_names.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

/// The number of letters to insert, delete or replace to turn one word into the other.
std::size_t editDistance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

[[noreturn]] void refuse(std::string_view word, const std::vector<const CLI::App*>& known) {
  constexpr std::size_t kTypingErrors = 2;
  std::string nearest, names;
  std::size_t least = kTypingErrors + 1;
  for (const CLI::App* subcommand : known) {
    const std::string& name = subcommand->get_name();
    names += (names.empty() ? "" : ", ") + name;
    const std::size_t distance = editDistance(word, name);
    if (distance >= least) continue;
    least = distance;
    nearest = name;
  }
  throw std::invalid_argument(
      inQuotes(word) + " is not a subcommand" + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
      (nearest.empty() ? "; the subcommands are: " : " The subcommands are: ") + names);
}

}  // namespace

void requireKnownSubcommands(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = &app;
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    const std::vector<const CLI::App*> known = command->get_subcommands([](const CLI::App*) { return true; });
    if (known.empty()) return;
    const auto named = std::ranges::find(known, std::string(argv[i]), &CLI::App::get_name);
    if (named == known.end()) refuse(argv[i], known);
    command = *named;
  }
}

}  // namespace octoblisk::demos
