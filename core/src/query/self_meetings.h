// Where a surface meets itself.
#pragma once

#include <vector>

#include "octoblisk/surface.h"

namespace octoblisk::detail {

/// Sets `meets` of every triangle that meets one that shares no corner with it.
void findSelfMeetings(const Surface& surface, std::vector<char>& meets);

}  // namespace octoblisk::detail
