#include "command_line/study_options.h"

#include <stdexcept>

#include "command_line/option_checks.h"

namespace octoblisk::demos {

void addStudyOptions(CLI::App& command, StudyTarget& target, const std::string& out_help) {
  command.add_option("-o,--out", target.out, out_help)->required()->check(notEmpty());
  addShardOptions(command, target);
}

void addShardOptions(CLI::App& command, StudyTarget& target) {
  command
      .add_option_function<std::string>(
          "--shard", [&target](const std::string& text) { target.shard = parseShard(text); },
          "i/n: only the i-th of n parts, e.g. one a task of a job array. OUT is a part then: octoblisk "
          "merge "
          "makes the table of all parts")
      ->check(CLI::Validator(
          [](const std::string& text) -> std::string {
            try {
              parseShard(text);
              return {};
            } catch (const std::invalid_argument& error) {
              return error.what();
            }
          },
          ""));
  command.add_flag(
      "--resume", target.resume,
      "Go on from the .partial file, which a run that did not come to its end leaves; begin where there "
      "is none");
}

}  // namespace octoblisk::demos
