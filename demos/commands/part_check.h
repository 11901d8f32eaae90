// Checks that a part of a study comes from the subcommand that it names.
#pragma once

#include <string_view>

#include "study/part_text.h"

namespace octoblisk::demos {

/// Throws std::invalid_argument if the options or tallies of a part of check or access, or the columns or
/// rows of a part of access, are not as that subcommand writes them. `text` is the text that the part was
/// read from.
void checkPart(const PartText& part, std::string_view text);

}  // namespace octoblisk::demos
