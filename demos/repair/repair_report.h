// Reports on a repaired path: a table and a summary.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "repair/path_repair.h"

namespace octoblisk::demos {

/// changes.csv: a row for each pose. Throws std::runtime_error naming a file that can't be written.
void writeChanges(const PathRepair& repair, std::span<const ToolPart> parts, const BodyNames& names,
                  const std::filesystem::path& file);

/// "poses 3-5: arm on hub or shroud", "motions to poses 7-8: belt on blade 2": the runs of poses, and of
/// motions, with the same remaining obstacle.
std::vector<std::string> describeLeft(const PathRepair& repair, std::span<const ToolPart> parts,
                                      const BodyNames& names);

/// "poses 3-5, pose 9": the working poses that lost their contact.
std::string describeLost(const PathRepair& repair);

}  // namespace octoblisk::demos
