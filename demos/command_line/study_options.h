// The options of subcommands that are studies: where the table goes, which part of it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "study/run_study.h"

namespace octoblisk::demos {

/// Adds --out, with its help, --shard and --resume.
void addStudyOptions(CLI::App& command, StudyTarget& target, const std::string& out_help);

/// Adds --shard and --resume alone.
void addShardOptions(CLI::App& command, StudyTarget& target);

}  // namespace octoblisk::demos
