// A study: many items, each answered to rows of one table, whoever answers them and wherever.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace octoblisk::demos {

/// The items begin … end − 1.
struct ItemRange {
  std::size_t begin = 0, end = 0;

  std::size_t size() const { return end - begin; }
  bool empty() const { return begin == end; }
  friend bool operator==(const ItemRange&, const ItemRange&) = default;
};

/// Something the answers depend on, told apart by a checksum of what was read.
struct StudyInput {
  std::string name;  ///< one word, e.g. "poses"
  std::uint64_t fingerprint = 0;

  friend bool operator==(const StudyInput&, const StudyInput&) = default;
};

/// What is asked. Equal studies have equal tables, byte for byte.
struct Study {
  std::string name;       ///< the subcommand that asks
  std::string columns;    ///< the table's first line, without its end
  std::size_t items = 0;  ///< counted from 0
  /// Items are answered in groups of so many, the last one smaller: what is found for one may depend on those
  /// before it in its group, on nothing else. Parts are made of whole groups.
  std::size_t group = 1;
  std::vector<StudyInput> inputs;
  std::string options;  ///< those that answers depend on, in one line
};

/// The answers to a group, or to what is left for the last.
struct AnsweredGroup {
  ItemRange items;
  std::string rows;   ///< whole lines of the table
  std::string tally;  ///< one line: what the study's summary needs of them
};

/// Answers whole groups, in their order. Called by one thread at a time; may itself use several.
using AnswerItems = std::function<std::vector<AnsweredGroup>(ItemRange)>;

/// In what the second is not the study that the first is, e.g. "poses"; empty where they are equal.
std::string differenceOf(const Study& first, const Study& second);

}  // namespace octoblisk::demos
