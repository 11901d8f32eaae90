// Toolpaths as CSV files: one rigid pose a line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <span>
#include <vector>

#include "octoblisk/types.h"
#include "toolpath/tool_move.h"

namespace octoblisk::demos {

/// Reads poses of the moving body in the fixed body's frame from a CSV file with the header
/// "x,y,z,qw,qx,qy,qz": a translation in mesh units and a quaternion, which is normalised. A column "feed"
/// may follow (readMoves). Throws std::runtime_error in one line naming the file, and the line where there is
/// one: what readCsv refuses, no poses, a quaternion whose norm is not within 1e-3 of 1, a translation beyond
/// ±TriangleMesh::kMaxCoordinate.
std::vector<Pose> readPoses(const std::filesystem::path& file);

/// The same with the feeds (mm/min; 0: rapid): a last column "feed"; without it they are 0.
/// Throws as readPoses, and for a feed below 0.
std::vector<ToolMove> readMoves(const std::filesystem::path& file);

/// A move and the line that it stands in, counted from 1.
struct MoveRow {
  ToolMove move;
  std::size_t line = 0;
};

/// The same with their lines.
std::vector<MoveRow> readMoveRows(const std::filesystem::path& file);

/// Writes "x,y,z,qw,qx,qy,qz" of a pose.
void writePose(std::ostream& stream, const Pose& pose);

/// Writes moves as readMoves reads them, with their feeds; as writePoses otherwise.
void writeMoves(const std::filesystem::path& file, std::span<const ToolMove> moves);

/// Writes poses as readPoses reads them. Rotations come back within 1e-15 an entry, as far as they are
/// orthonormal; translations come back bit by bit.
/// Throws std::runtime_error naming the file where it cannot be written.
void writePoses(const std::filesystem::path& file, std::span<const Pose> poses);

}  // namespace octoblisk::demos
