// Makes the table of a study from its parts.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.h"
#include "io/new_file.h"
#include "study/part_text.h"
#include "study/study.h"

namespace octoblisk::demos {

/// A part in a file, or in memory.
struct PartFile {
  /// Maps the file. Throws std::runtime_error naming it.
  explicit PartFile(std::filesystem::path file);
  PartFile(std::filesystem::path file, std::string text) : name(std::move(file)), memory(std::move(text)) {}

  std::string_view text() const;

  std::filesystem::path name;
  std::string memory;
  std::shared_ptr<const detail::MappedFile> mapped;  ///< null: the text is in memory
  PartText part;                                     ///< what readPart finds in the text; not read at first
};

/// Writes the groups of all parts, which were read, in the order of their items: their rows or, with the head
/// of a part, also their own lines. A group is written once. Returns the tallies.
std::vector<std::string> writeInOrder(std::span<const PartFile> files, const std::string& head,
                                      NewFile& whole);

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
