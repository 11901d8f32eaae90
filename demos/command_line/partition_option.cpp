#include "command_line/partition_option.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <string>

#include "io/quoted_text.h"

namespace octoblisk::demos {

namespace {

/// Removes ":N" with N from 1 to `most` from the front of a text.
bool takeNumber(std::string& text, int most, int& number) {
  if (!text.starts_with(':')) return false;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  if (error != std::errc() || number < 1 || number > most) return false;
  text.erase(0, static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

void addPartitionOption(CLI::App& command, BuildOptions& options) {
  const auto read = [&options](const std::string& text) {
    options.partition = text == "clustered" ? PartitionKind::clustering : PartitionKind::paper;
    if (text == "clustered") return;
    constexpr int kMaxFnop = 999'999;
    const bool is_read = text.starts_with("paper") && [&, rest = text.substr(5)]() mutable {
      options.clusters = 0;
      return rest.empty() ||
             (takeNumber(rest, 8, options.clusters) &&
              (rest.empty() || (takeNumber(rest, kMaxFnop, options.leaf_capacity) && rest.empty())));
    }();
    if (!is_read) {
      throw CLI::ValidationError("--partition",
                                 inQuotes(text) + " is not clustered or paper[:K[:FNOP]], K from 1 to 8");
    }
  };
  command
      .add_option_function<std::string>(
          "--partition", read,
          "Division of the triangles into trees: clustered, or the paper's method paper[:K[:FNOP]], which "
          "makes K clusters per part (a blade) and an octree with FNOP triangles per leaf for each; without "
          "K, "
          "the best K from 2 to 8; without FNOP, 8. The verdicts are the same. Default: clustered")
      ->type_name("PARTITION");
}

}  // namespace octoblisk::demos
