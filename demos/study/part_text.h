// The text of a part of a study: a head that names the study and the part's items, the table's header, then
// groups of rows. Each group has a line with its items, length and tally, and a checksum of these, of its
// rows and of the head: so truncated, changed and mixed parts are detected. Our own lines begin with #, so
// CSV readers with comments can read a part.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "study/study.h"

namespace octoblisk::demos {

/// A group, and the place of its rows in the text.
struct GroupInText {
  ItemRange items;
  std::size_t begin = 0, bytes = 0;
  std::string tally;
};

struct PartText {
  Study study;
  ItemRange items;                  ///< of the part
  std::vector<GroupInText> groups;  ///< the valid ones up to the first invalid one, in the order of the text
  std::size_t sound_bytes = 0;      ///< of the head and the groups together
};

/// Everything before the groups.
std::string headOf(const Study& study, ItemRange part);

std::string textOf(const AnsweredGroup& group, std::string_view head);

/// Reads a part, which may end anywhere after its head. Throws std::invalid_argument if the text does not
/// begin with a complete head.
PartText readPart(std::string_view text);

/// The items of the part that no group contains.
std::vector<ItemRange> missingItems(const PartText& part);

}  // namespace octoblisk::demos
