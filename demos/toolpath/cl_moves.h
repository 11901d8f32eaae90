// The poses of a tool out of a CL file, and into one.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "toolpath/cl_file.h"
#include "toolpath/tool_move.h"

namespace octoblisk::demos {

/// The poses of the tool: its frame's x axis is the tool axis, the position its origin, and z the second
/// axis. Throws std::invalid_argument, naming the line, where a move has no second axis.
std::vector<ToolMove> toolMovesOf(const ClFile& file);

/// The same where moves may lack the second axis: six numbers leave open how the tool turns about its own
/// axis. Then its contact wheel lies along the blisk's surface where that is nearest to the position: z is
/// square to the tool axis and to the way from there; of the two such ways it takes that nearer to the next
/// pose's on the side of the move that comes nearest to the blisk, where z = x × n with n away from the
/// surface. The belt grinder is the same either way round.
std::vector<ToolMove> toolMovesOf(const ClFile& file, const ClusteredOctree& blisk);

/// Writes the statement of a pose, without an end of line: `word` (GOTO or FROM) with nine numbers, lengths
/// in units of `unit` mm.
void writeGoto(std::ostream& stream, const char* word, const Pose& tool_in_blisk, double unit);

/// Writes moves as GOTO with nine numbers, in mm, with FEDRAT in mm/min where the feed changes and RAPID
/// where it is 0. readClFile and toolMovesOf give the moves back: positions and feeds bit by bit, rotations
/// within 1e-15 an entry. Throws std::runtime_error naming the file where it cannot be written.
void writeClFile(const std::filesystem::path& file, std::span<const ToolMove> moves);

}  // namespace octoblisk::demos
