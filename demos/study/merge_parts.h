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

/// Throws std::invalid_argument if a part does not come from its subcommand; `text` is the text that it was
/// read from.
using CheckPart = std::function<void(const PartText& part, std::string_view text)>;

/// Writes the table that the study gives in one run, from its parts in any order. The file stays unchanged
/// until all parts are checked. Throws std::runtime_error naming a part that cannot be read, is unfinished,
/// damaged or refused by the check, belongs to another study than the first, repeats another part's items, or
/// leaves items missing; or naming the file if it is one of the parts or cannot be written.
MergedStudy mergeParts(const std::vector<std::filesystem::path>& parts, const std::string& out,
                       const CheckPart& check = {});

}  // namespace octoblisk::demos
