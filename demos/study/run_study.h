// Runs a study, or a part of it, and writes its file.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/ranks.h"
#include "study/study.h"

namespace octoblisk::demos {

/// The output of a study.
struct StudyTarget {
  std::string out;
  std::optional<Shard> shard;  ///< only this part, as a part file (part_text.h) instead of a table
  bool resume = false;         ///< continues an unfinished run, if there is one
};

struct StudyOutcome {
  std::vector<std::string> tallies;  ///< of all groups in the file, in order; only on the first rank
  std::size_t answered = 0;          ///< number of items answered by this run; only on the first rank
  std::chrono::duration<double, std::micro> time{};  ///< time to answer them
};

/// Answers the study and writes the target's file, which stays unchanged until all items are answered.
/// Meanwhile, and after an interrupted run, the answers are in the journals (study_journal.h). All ranks call
/// it, and each answers its share; the first shows a progress bar at a terminal and writes the file.
///
/// Throws std::runtime_error naming the file if it is also an input, cannot be written, or cannot be
/// continued; Stopped (stop_signal.h) on SIGINT and SIGTERM; and what `answer` throws.
StudyOutcome runStudy(const Study& study, const StudyTarget& target,
                      const std::vector<std::filesystem::path>& files_read, Ranks& ranks,
                      const AnswerItems& answer);

}  // namespace octoblisk::demos
