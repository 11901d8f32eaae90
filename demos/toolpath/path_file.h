// Toolpaths of either kind of file.
#pragma once

#include <filesystem>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "toolpath/cl_file.h"
#include "toolpath/tool_move.h"

namespace octoblisk::demos {

struct PathFile {
  std::vector<ToolMove> moves;
  std::vector<ClSkipped> unknown;  ///< statements of a CL file that were passed over and may mean anything
};

/// Whether a file is APT: .csv files are not, those of the extensions .apt, .cl, .cls, .clf, .ncl and
/// .aptsource are, and others are unless they begin with an x and a comma, as tables of poses do.
bool isClFile(const std::filesystem::path& file);

/// Reads a table of poses (pose_file.h) or a CL file (cl_file.h). The blisk tells what a CL file may leave
/// open. Throws std::runtime_error in one line naming the file, and the line where there is one.
PathFile readPathFile(const std::filesystem::path& file, const ClusteredOctree& blisk);

}  // namespace octoblisk::demos
