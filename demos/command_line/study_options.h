// The options of subcommands that are studies: the table's file, and the part of it to compute.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "study/run_study.h"

namespace octoblisk::demos {

/// Adds --out with the given help, --shard and --resume.
void addStudyOptions(CLI::App& command, StudyTarget& target, const std::string& out_help);

/// Adds only --shard and --resume.
void addShardOptions(CLI::App& command, StudyTarget& target);

}  // namespace octoblisk::demos
