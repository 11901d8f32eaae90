// Reads and writes toolpaths as CSV files: one rigid pose per line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <span>
#include <vector>

#include "octoblisk/types.h"
#include "toolpath/tool_motion.h"

namespace octoblisk::demos {

/// Reads poses of the moving body in the fixed body's frame from a CSV file with the header
/// "x,y,z,qw,qx,qy,qz": a translation in mesh units and a quaternion, which is normalised. A column "feed"
/// may follow (readMotions). Throws std::runtime_error with a one-line message that names the file, and the
/// line if there is one: for what readCsv refuses, no poses, a quaternion whose norm is not within 1e-3 of 1,
/// or a translation beyond ±TriangleMesh::kMaxCoordinate.
std::vector<Pose> readPoses(const std::filesystem::path& file);

/// The same with the feeds (mm/min; 0: rapid) of a last column "feed"; without that column they are 0. Throws
/// as readPoses, and for a negative feed.
std::vector<ToolMotion> readMotions(const std::filesystem::path& file);

/// A motion and its line, counted from 1.
struct MotionRow {
  ToolMotion motion;
  std::size_t line = 0;
};

/// The same with their lines.
std::vector<MotionRow> readMotionRows(const std::filesystem::path& file);

/// Writes a pose as "x,y,z,qw,qx,qy,qz".
void writePose(std::ostream& stream, const Pose& pose);

/// Writes motions with their feeds for readMotions; otherwise as writePoses.
void writeMotions(const std::filesystem::path& file, std::span<const ToolMotion> motions);

/// Writes poses for readPoses. Translations are read back bit by bit, rotations within 1e-15 per entry if
/// they are orthonormal. Throws std::runtime_error naming the file if it cannot be written.
void writePoses(const std::filesystem::path& file, std::span<const Pose> poses);

}  // namespace octoblisk::demos
