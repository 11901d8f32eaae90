// Reads and writes toolpaths as tables of poses or CL files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "toolpath/cl_file.h"
#include "toolpath/tool_motion.h"

namespace octoblisk::demos {

/// The lines of a motion in its file.
struct MotionLines {
  std::size_t first = 0, last = 0;  ///< counted from 1
  double unit = 1.0;                ///< mm, of the lengths in these lines
};

struct PathFile {
  std::vector<ToolMotion> motions;
  std::vector<MotionLines> lines;  ///< per motion
  std::vector<ClUnknown> unknown;  ///< ignored words of a CL file
  std::size_t second_tool = 0;     ///< line where a CL file first changes the tool; 0: it never does

  std::vector<Pose> poses() const;
};

/// True if a file is APT. Files named .csv are not; files named .apt, .cl, .cls, .clf, .ncl and .aptsource
/// are; other files are unless they begin with an x and a comma, as tables of poses do.
bool isClFile(const std::filesystem::path& file);

/// Reads a table of poses (pose_file.h) or a CL file (cl_file.h). The blisk determines what a CL file leaves
/// open. Throws std::runtime_error with a one-line message that names the file, and the line if there is one.
PathFile readPathFile(const std::filesystem::path& file, const ClusteredOctree& blisk);

/// Writes the file read from `source` with new poses, one per old pose, in its format and with its feeds. The
/// lines of unchanged motions stay as they are, and so do all lines between them. In a CL file a motion may
/// depend on an earlier one, by GODLTA or an inherited tool axis; it is written out if that one has changed.
/// Changed motions of a CL file have nine numbers (cl_motions.h). Throws std::runtime_error naming a file
/// that cannot be read or written.
void writeChangedPath(const PathFile& read, const std::filesystem::path& source, const ClusteredOctree& blisk,
                      std::span<const Pose> poses, const std::filesystem::path& target);

}  // namespace octoblisk::demos
