// Makes the table of a study from its parts.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "study/part_text.h"
#include "study/study.h"

namespace octoblisk::demos {

struct MergedStudy {
  Study study;
  std::vector<std::string> tallies;  ///< of all groups, in order
};

/// Throws std::invalid_argument where a part is none of its subcommand; `text` is what it was read from.
using CheckPart = std::function<void(const PartText& part, std::string_view text)>;

/// Writes the table that the study gives in one run, from its parts in any order, to a file that is what it
/// was until all is found to be right. Throws std::runtime_error naming the part that cannot be read, is
/// unfinished, damaged or refused by the check, is of another study than the first, or holds what another
/// does, or beside which items are missing; or the file, where it is one of the parts or cannot be written.
MergedStudy mergeParts(const std::vector<std::filesystem::path>& parts, const std::string& out,
                       const CheckPart& check = {});

}  // namespace octoblisk::demos
