// Toolpaths as cutter location files: APT text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "toolpath/tool_move.h"

namespace octoblisk::demos {

/// One motion statement. Lengths in mm, whatever the file's units.
struct ClMove {
  Vec3 position = Vec3::Zero();
  Vec3 tool_axis = Vec3::UnitZ();   ///< of length 1, from the tool's tip to where it is held
  std::optional<Vec3> second_axis;  ///< of length 1, square to the tool axis: GOTO with nine numbers
  double feed = 0.0;                ///< mm/min; 0: rapid, or not told
  std::size_t line = 0;
};

/// A statement that has no meaning here, and where it is first met.
struct ClSkipped {
  std::string word;
  std::size_t line = 0;
};

struct ClFile {
  std::vector<ClMove> moves;
  std::vector<ClSkipped> unknown;  ///< words that may mean anything; one entry a word
};

/// Reads FROM, GOTO and GODLTA with UNITS, FEDRAT, RAPID, SPINDL, TLAXIS and MULTAX.
///
/// Without UNITS lengths are mm; feeds go by minute in the file's units, by IPM or MMPM, or by revolution
/// (PERREV, IPR, MMPR) of a spindle whose speed SPINDL tells in RPM. RAPID is for the next move alone. GOTO
/// takes a point, a point and a tool axis (its length within 1e-3 of 1), or a point, a tool axis and a second
/// axis, our own way to tell a whole pose. Machine functions and the cutter (CUTTER, LOADTL, SPINDL, COOLNT,
/// PPRINT and their like) are passed over.
///
/// Throws std::runtime_error in one line naming the file, and the line: what AptText refuses; arcs and other
/// motions than those above (CIRCLE, MOVARC, CYCLE, GOFWD, ...); statements that move or turn what follows
/// (TRACUT, ORIGIN, ROTATE, COPY, MODE/INCR, ...); wrong counts, units, axes or numbers; coordinates beyond
/// ±TriangleMesh::kMaxCoordinate; statements behind FINI; a file without a move.
ClFile readClFile(const std::filesystem::path& file);

/// The poses of the tool: its frame's x axis is the tool axis, the position its origin, and z the second
/// axis. Throws std::invalid_argument, naming the line, where a move has no second axis.
std::vector<ToolMove> toolMovesOf(const ClFile& file);

/// The same where moves may lack the second axis: six numbers leave open how the tool turns about its own
/// axis. Then its contact wheel lies along the blisk's surface where that is nearest to the position: z is
/// square to the tool axis and to the way from there; of the two such ways it takes that nearer to the next
/// pose's on the side of the move that comes nearest to the blisk, where z = x × n with n away from the
/// surface. The belt grinder is the same either way round.
std::vector<ToolMove> toolMovesOf(const ClFile& file, const ClusteredOctree& blisk);

/// Writes moves as GOTO with nine numbers, in mm, with FEDRAT in mm/min where the feed changes and RAPID
/// where it is 0. readClFile and toolMovesOf give the moves back: positions and feeds bit by bit, rotations
/// within 1e-15 an entry. Throws std::runtime_error naming the file where it cannot be written.
void writeClFile(const std::filesystem::path& file, std::span<const ToolMove> moves);

}  // namespace octoblisk::demos
