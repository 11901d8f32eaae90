// The text of a part of a study: a head that tells of which study it is and of which items, the table's first
// line, then groups of rows. Each group has a line that tells its items, length and tally, and a checksum of
// these, of its rows and of the head, so that what was cut off, changed or put together from two parts is
// found out. Lines of our own begin with #: what reads CSV with comments reads a part.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "study/study.h"

namespace octoblisk::demos {

/// A group, and where its rows are in the text.
struct GroupInText {
  ItemRange items;
  std::size_t begin = 0, bytes = 0;
  std::string tally;
};

struct PartText {
  Study study;
  ItemRange items;                  ///< that the part is for
  std::vector<GroupInText> groups;  ///< sound ones up to the first that is not, as they come in the text
  std::size_t sound_bytes = 0;      ///< of head and groups together
};

/// All before the groups.
std::string headOf(const Study& study, ItemRange part);

std::string textOf(const AnsweredGroup& group, std::string_view head);

/// Reads a part, which may end anywhere behind its head. Throws std::invalid_argument where the text does not
/// begin with a whole head.
PartText readPart(std::string_view text);

/// The items of the part that are in none of the groups.
std::vector<ItemRange> missingItems(const PartText& part);

}  // namespace octoblisk::demos
