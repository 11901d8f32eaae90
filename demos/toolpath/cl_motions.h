// Converts the motions of a CL file to poses of the tool and back.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "toolpath/cl_file.h"
#include "toolpath/tool_motion.h"

namespace octoblisk::demos {

/// The poses of the tool: the x axis of its frame is the tool axis, its position the origin, and z the second
/// axis. Throws std::invalid_argument naming the line if a motion has no second axis.
std::vector<ToolMotion> toolMotionsOf(const ClFile& file);

/// The same for motions that may lack the second axis: six numbers do not determine the tool's turn about its
/// own axis. The contact wheel then lies along the blisk's surface at its nearest point to the position: z is
/// perpendicular to the tool axis and to the direction from that point. Two such directions exist. On the
/// motion that comes nearest to the blisk, z = x × n with n pointing away from the surface. Every other
/// motion takes the direction that is closer to that of its neighbour towards this motion. The belt grinder
/// is symmetric, so both directions grind alike.
std::vector<ToolMotion> toolMotionsOf(const ClFile& file, const ClusteredOctree& blisk);

/// Writes the statement of a pose, without an end of line: `word` (GOTO or FROM) with nine numbers, lengths
/// in units of `unit` mm.
void writeGoto(std::ostream& stream, const char* word, const Pose& tool_in_blisk, double unit);

/// Writes motions as GOTO with nine numbers, in mm, with FEDRAT in mm/min when the feed changes and RAPID
/// when it is 0. readClFile and toolMotionsOf read the motions back: positions and feeds bit by bit,
/// rotations within 1e-15 per entry. Throws std::runtime_error naming the file if it cannot be written.
void writeClFile(const std::filesystem::path& file, std::span<const ToolMotion> motions);

}  // namespace octoblisk::demos
