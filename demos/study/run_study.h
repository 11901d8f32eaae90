// Runs a study, or a part of it, to its file.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/ranks.h"
#include "study/shard.h"
#include "study/study.h"

namespace octoblisk::demos {

/// Where a study goes.
struct StudyTarget {
  std::string out;
  std::optional<Shard> shard;  ///< only this part, as a part file (part_text.h) instead of a table
  bool resume = false;         ///< goes on from what an unfinished run left, if it left anything
};

struct StudyOutcome {
  std::vector<std::string> tallies;  ///< of all groups in the file, in order; at the first rank
  std::size_t answered = 0;          ///< items, by this run
  std::chrono::duration<double, std::micro> time{};  ///< that they took
};

/// Answers what is asked and writes it to the target's file, which is what it was until all is answered.
/// Meanwhile, and after a run that was ended before, answers are in OUT.partial. All ranks call it; the first
/// writes, and shows a progress bar at a terminal.
///
/// Throws std::runtime_error naming the file where it is one of those read, cannot be written, or holds what
/// cannot be gone on from; Stopped (stop_signal.h) on SIGINT and SIGTERM; what `answer` throws.
StudyOutcome runStudy(const Study& study, const StudyTarget& target,
                      const std::vector<std::filesystem::path>& files_read, Ranks& ranks,
                      const AnswerItems& answer);

}  // namespace octoblisk::demos
