// Whether a part of a study could be of the subcommand that it names.
#pragma once

#include <string_view>

#include "study/part_text.h"

namespace octoblisk::demos {

/// Throws std::invalid_argument where the options or tallies of a part of check or access, or the columns or
/// rows of one of access, are not as that writes them. `text` is the one that the part was read from.
void checkPart(const PartText& part, std::string_view text);

}  // namespace octoblisk::demos
