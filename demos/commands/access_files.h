// The files and the summary that octoblisk access adds to its table of points; octoblisk merge adds the same.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>

#include "access/access_table.h"

namespace octoblisk::demos {

/// The study's name in the part files.
inline constexpr const char* kAccessName = "access";

/// Makes ranges.csv and, if wanted, map.png from the table of points, beside it, and prints their names.
/// Throws naming a file that cannot be read or written.
void finishAccess(const std::filesystem::path& points, const AccessQuestion& question, bool picture);

/// Prints the summary of a study's tallies and returns the exit code.
int printAccess(std::span<const std::string> tallies, const AccessQuestion& question, std::ostream& words);

}  // namespace octoblisk::demos
