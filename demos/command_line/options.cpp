#include "command_line/options.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

template <typename Number>
bool parse(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && stop == text.data() + text.size();
}

/// Removes ":N" with N from 1 to `most` from the front of a text.
bool takeNumber(std::string& text, int most, int& number) {
  if (!text.starts_with(':')) return false;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  if (error != std::errc() || number < 1 || number > most) return false;
  text.erase(0, static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

CLI::Validator numberFrom(double least, double greatest, bool above) {
  const auto check = [=](const std::string& text) -> std::string {
    double value = 0.0;
    // The comparisons are false for NaN.
    if (parse(text, value) && value <= greatest && (above ? value > least : value >= least)) return {};
    std::ostringstream message;
    message.precision(12);
    message << inQuotes(text) << " is not a number " << (above ? "above " : "from ") << least
            << (above ? " and at most " : " to ") << greatest;
    return message.str();
  };
  return CLI::Validator(check, "");
}

CLI::Validator wholeNumberFrom(std::int64_t least, std::int64_t greatest) {
  const auto check = [=](const std::string& text) -> std::string {
    std::int64_t value = 0;
    if (parse(text, value) && value >= least && value <= greatest) return {};
    return inQuotes(text) + " is not a whole number from " + std::to_string(least) + " to " +
           std::to_string(greatest);
  };
  return CLI::Validator(check, "");
}

CLI::Validator notEmpty() {
  return CLI::Validator(
      [](const std::string& text) { return std::string(text.empty() ? "the name is empty" : ""); }, "");
}

CLI::Option* addFile(CLI::App& command, const std::string& names, std::string& file, const std::string& help,
                     const std::string& placeholder) {
  return addOption(command, names, file, placeholder, notEmpty(), help);
}

CLI::Option* addChoice(CLI::App& command, const std::string& names, std::string& value,
                       const std::vector<std::string>& choices, const std::string& help) {
  const auto check = [=](const std::string& text) -> std::string {
    if (std::ranges::find(choices, text) != choices.end()) return {};
    return inQuotes(text) + " is not one of " + CLI::detail::join(choices, ", ");
  };
  return addOption(command, names, value, CLI::detail::join(choices, "|"), CLI::Validator(check, ""), help);
}

CLI::Option* addOut(CLI::App& command, std::string& out, const std::string& help,
                    const std::string& placeholder) {
  return addFile(command, "-o,--out", out, help, placeholder)->required();
}

void makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error(folder.string() + ": cannot create the folder: " + error.message() +
                             ": choose another --out");
}

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
          "K, the best K from 2 to 8; without FNOP, 8. The verdicts are the same. Default: clustered")
      ->type_name("PARTITION");
}

void addReportOption(CLI::App& command, bool& report) {
  command.add_flag("--report,!--no-report", report,
                   "Write report.html, run.glb and the files for ParaView, or do not");
}

void addShardOptions(CLI::App& command, StudyTarget& target) {
  const auto refusalOf = [](const std::string& text) -> std::string {
    try {
      parseShard(text);
      return {};
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  command
      .add_option_function<std::string>(
          "--shard", [&target](const std::string& text) { target.shard = parseShard(text); },
          "Compute only part I (1 to N) of N, for example as one task of a job array. OUT is then a part "
          "file: octoblisk merge makes the table from all parts")
      ->type_name("I/N")
      ->check(CLI::Validator(refusalOf, ""));
  command.add_flag(
      "--resume", target.resume,
      "Continue from the .partial file of an interrupted run; without such a file, start from the beginning");
}

}  // namespace octoblisk::demos
