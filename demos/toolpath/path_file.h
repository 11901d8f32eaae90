// Toolpaths of either kind of file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "toolpath/cl_file.h"
#include "toolpath/tool_move.h"

namespace octoblisk::demos {

/// Where a move stands in its file.
struct MoveLines {
  std::size_t first = 0, last = 0;  ///< counted from 1
  double unit = 1.0;                ///< mm, of the lengths there
};

struct PathFile {
  std::vector<ToolMove> moves;
  std::vector<MoveLines> lines;    ///< of each move
  std::vector<ClSkipped> unknown;  ///< statements of a CL file that were passed over and may mean anything

  std::vector<Pose> poses() const;
};

/// Whether a file is APT: .csv files are not, those of the extensions .apt, .cl, .cls, .clf, .ncl and
/// .aptsource are, and others are unless they begin with an x and a comma, as tables of poses do.
bool isClFile(const std::filesystem::path& file);

/// Reads a table of poses (pose_file.h) or a CL file (cl_file.h). The blisk tells what a CL file may leave
/// open. Throws std::runtime_error in one line naming the file, and the line where there is one.
PathFile readPathFile(const std::filesystem::path& file, const ClusteredOctree& blisk);

/// Writes what was read from `source` with other poses, as many: in its format and with its feeds. Lines of
/// moves whose pose is not changed stay as they are, and so does all between them; but in a CL file a move
/// that hangs on one before, by GODLTA or a tool axis that goes on, is written out where that has changed.
/// Changed moves of a CL file have nine numbers (cl_moves.h). Throws std::runtime_error naming a file that
/// cannot be read or written.
void writeChangedPath(const PathFile& read, const std::filesystem::path& source, const ClusteredOctree& blisk,
                      std::span<const Pose> poses, const std::filesystem::path& target);

}  // namespace octoblisk::demos
