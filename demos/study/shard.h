// Parts of a study for machines that know nothing of each other, e.g. the tasks of a job array.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/study.h"

namespace octoblisk::demos {

/// One of `count` parts, counted from 1. By default all.
struct Shard {
  std::size_t index = 1, count = 1;
};

/// "3/7": the third of seven. Throws std::invalid_argument telling what the text must be.
Shard parseShard(const std::string& text);

/// Its items: neighbours, so that a part is one piece of the table. Parts differ by a group at most; where
/// there are more of them than groups, some are empty.
ItemRange itemsOf(const Study& study, Shard shard);

}  // namespace octoblisk::demos
