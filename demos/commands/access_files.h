// What octoblisk access leaves beside its table of points, and tells: by itself, and by octoblisk merge.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>

#include "access/access_table.h"

namespace octoblisk::demos {

/// The name of its studies.
inline constexpr const char* kAccessName = "access";

/// Writes ranges.csv and, if wanted, map.png beside the table of points, of which they are made; tells so.
/// Throws naming a file that cannot be read or written.
void finishAccess(const std::filesystem::path& points, const AccessQuestion& question, bool picture);

/// Tells the summary of a study's tallies; the exit code.
int tellAccess(std::span<const std::string> tallies, const AccessQuestion& question, std::ostream& words);

}  // namespace octoblisk::demos
