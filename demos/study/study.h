// A study: many items, each answered by rows of one table, independent of the processes that answer them.
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

/// An input that the answers depend on, identified by a checksum of its content.
struct StudyInput {
  std::string name;  ///< one word, e.g. "poses"
  std::uint64_t fingerprint = 0;

  friend bool operator==(const StudyInput&, const StudyInput&) = default;
};

/// The request. Equal studies have equal tables, byte for byte.
struct Study {
  std::string name;       ///< the subcommand
  std::string columns;    ///< the table's header, without its line end
  std::size_t items = 0;  ///< counted from 0

  /// Items are answered in groups of this size; the last one may be smaller. An answer may depend only on the
  /// items before it in its group. Parts consist of whole groups.
  std::size_t group = 1;
  std::vector<StudyInput> inputs;
  std::string options;  ///< the options that the answers depend on, in one line
};

/// The answers to a group; the last group may be smaller.
struct AnsweredGroup {
  ItemRange items;
  std::string rows;   ///< whole lines of the table
  std::string tally;  ///< one line with the data for the study's summary
};

/// Answers whole groups, in order. It is called by one thread at a time and may use several threads itself.
using AnswerItems = std::function<std::vector<AnsweredGroup>(ItemRange)>;

/// The first difference of two studies, e.g. "poses"; empty if they are equal.
std::string differenceOf(const Study& first, const Study& second);

/// One of `count` parts of a study for independent machines, for example the tasks of a job array. Counted
/// from 1; by default the only one.
struct Shard {
  std::size_t index = 1, count = 1;
};

/// "3/7": the third of seven. Throws std::invalid_argument with a message that describes the format.
Shard parseShard(const std::string& text);

/// Its items are consecutive, so a part is one piece of the table. Parts differ by at most one group; if
/// there are more parts than groups, some are empty.
ItemRange itemsOf(const Study& study, Shard shard);

}  // namespace octoblisk::demos
