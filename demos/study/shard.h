// Parts of a study for independent machines, for example the tasks of a job array.
#pragma once

#include <cstddef>
#include <string>

#include "study/study.h"

namespace octoblisk::demos {

/// One of `count` parts, counted from 1. By default the only one.
struct Shard {
  std::size_t index = 1, count = 1;
};

/// "3/7": the third of seven. Throws std::invalid_argument with a message that describes the format.
Shard parseShard(const std::string& text);

/// Its items are consecutive, so a part is one piece of the table. Parts differ by at most one group; if
/// there are more parts than groups, some are empty.
ItemRange itemsOf(const Study& study, Shard shard);

}  // namespace octoblisk::demos
