// Reports on a repaired path: a table, a summary and a replay.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "grinding/grinding_run.h"
#include "repair/path_repair.h"
#include "report/replay.h"

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

/// The two runs are those of octoblisk grind for the original and the repaired path; both have one pose per
/// pose of the repair.
Replay repairReplay(const PathRepair& repair, const GrindingRun& before, const GrindingRun& after);

}  // namespace octoblisk::demos
