#include "command_line/study_options.h"

#include <stdexcept>

#include "command_line/option_checks.h"

namespace octoblisk::demos {

void addStudyOptions(CLI::App& command, StudyTarget& target, const std::string& out_help) {
  command.add_option("-o,--out", target.out, out_help)->type_name("FILE")->required()->check(notEmpty());
  addShardOptions(command, target);
}

void addShardOptions(CLI::App& command, StudyTarget& target) {
  command
      .add_option_function<std::string>(
          "--shard", [&target](const std::string& text) { target.shard = parseShard(text); },
          "Compute only part I (1 to N) of N, for example as one task of a job array. OUT is then a part "
          "file: "
          "octoblisk merge makes the table from all parts")
      ->type_name("I/N")
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
      "Continue from the .partial file of an interrupted run; without such a file, start from the beginning");
}

}  // namespace octoblisk::demos
