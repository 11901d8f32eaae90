// octoblisk merge: joins the parts of a study that --shard wrote into one table.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "command_line/help.h"
#include "command_line/options.h"
#include "commands/access_files.h"
#include "commands/check_summary.h"
#include "commands/commands.h"
#include "commands/part_check.h"
#include "io/new_file.h"
#include "io/quoted_text.h"
#include "study/merge_parts.h"

namespace octoblisk::demos {
namespace {

struct MergeRequest {
  std::vector<std::string> parts;
  std::string out;
};

/// Prints the summary of the study's own subcommand and returns its exit code.
int printStudy(const MergedStudy& merged, const std::filesystem::path& out) {
  std::ostream& words = isStandardOutput(out) ? std::cerr : std::cout;
  if (merged.study.name == kCheckName) {
    const CheckSummary summary = summaryOfTallies(merged.tallies);
    print(words, summary, optionsOfLine(merged.study.options), std::nullopt);
    return summary.isClean() ? 0 : 1;
  }
  if (merged.study.name == kAccessName) {
    const AccessQuestion question = questionOfLine(merged.study.options);
    const int exit_code = printAccess(merged.tallies, question, words);
    if (!isDevice(out)) finishAccess(out, question, true);
    return exit_code;
  }
  words << merged.study.items << " items of a study by " << inQuotes(merged.study.name) << '\n';
  return 0;
}

}  // namespace

void addMergeCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "merge");
  const auto request = std::make_shared<MergeRequest>();
  addOption(command, "PART", request->parts, "FILE", notEmpty(), "All parts of the study, in any order")
      ->required();
  addOut(command, request->out, "CSV file to write, or - for standard output");
  command.callback([request, &exit_code] {
    const std::vector<std::filesystem::path> parts(request->parts.begin(), request->parts.end());
    exit_code = printStudy(mergeParts(parts, request->out, checkPart), request->out);
  });
}

}  // namespace octoblisk::demos
