// Declares the options that subcommands share, and options of a kind: files, numbers, choices.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include "octoblisk/build_options.h"
#include "study/run_study.h"

namespace octoblisk::demos {

// Checks of option values, with short messages.

/// A finite number from `least` to `greatest`; excludes `least` itself if `above` is set.
CLI::Validator numberFrom(double least, double greatest, bool above = false);

/// A whole number from `least` to `greatest`, in digits.
CLI::Validator wholeNumberFrom(std::int64_t least, std::int64_t greatest);

/// The name of a file or folder. An unset variable in a script often makes it empty.
CLI::Validator notEmpty();

/// Adds an option with a placeholder for its value, and a check. The help shows the default of numbers and
/// texts.
template <typename Value>
CLI::Option* addOption(CLI::App& command, const std::string& names, Value& value,
                       const std::string& placeholder, const CLI::Validator& check, const std::string& help) {
  CLI::Option* const option = command.add_option(names, value, help)->type_name(placeholder)->check(check);
  if (std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string>) option->capture_default_str();
  return option;
}

/// Adds an option for the name of a file.
CLI::Option* addFile(CLI::App& command, const std::string& names, std::string& file, const std::string& help,
                     const std::string& placeholder = "FILE");

/// Adds an option for one of these texts.
CLI::Option* addChoice(CLI::App& command, const std::string& names, std::string& value,
                       const std::vector<std::string>& choices, const std::string& help);

/// Adds --out, which is required: a file, or "DIR" for a folder.
CLI::Option* addOut(CLI::App& command, std::string& out, const std::string& help,
                    const std::string& placeholder = "FILE");

/// Creates the folder of --out if it is missing. Throws std::runtime_error naming it.
void makeFolder(const std::filesystem::path& folder);

/// Adds --partition clustered|paper[:K[:FNOP]]: our division of triangles into trees, or the paper's. Without
/// K, each part gets its k_opt.
void addPartitionOption(CLI::App& command, BuildOptions& options);

/// Adds --report, which is the default, and --no-report, of the subcommands that write a replay.
void addReportOption(CLI::App& command, bool& report);

/// Adds --shard and --resume of subcommands that are studies (study/run_study.h): the part to compute.
void addShardOptions(CLI::App& command, StudyTarget& target);

}  // namespace octoblisk::demos
