// A tool put together: its parts' meshes with their trees, and what they may touch.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "grinding/verdict.h"

namespace octoblisk::demos {

struct ToolAssembly {
  std::vector<ToolPart> parts;
  /// But for the ground blade, and near_miss.
  VerdictRules rules;
  std::vector<std::string> notes;  ///< what was mended in the files, a line each
};

/// The built-in belt grinder: the belt may touch the ground blade.
ToolAssembly builtInTool(double max_depth);

/// A belt alone, which may touch the ground blade. Throws as readMesh.
ToolAssembly beltAlone(const std::filesystem::path& belt, double max_depth);

/// By a tool file (tool_file.h); `max_depth` (mm) is of parts that have none of their own. The grinding part
/// is that of the first row of "allowed" for "ground", kNoPart where there is none. Throws as readToolFile,
/// and std::runtime_error naming the tool file and the key of a mesh that cannot be read.
ToolAssembly toolOf(const std::filesystem::path& tool_file, double max_depth);

/// The greatest number of a blade in the rules' tables, 0 where they have none.
int greatestBladeNamed(const VerdictRules& rules);

}  // namespace octoblisk::demos
