// A complete tool: its parts' meshes with their trees, and the rules of what they may touch.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "grinding/verdict.h"

namespace octoblisk::demos {

struct ToolAssembly {
  std::vector<ToolPart> parts;
  /// Without the ground blade and near_miss.
  VerdictRules rules;
  std::vector<std::string> notes;  ///< repairs made to the files, one line each
};

/// The built-in belt grinder: the belt may touch the ground blade.
ToolAssembly builtInTool(double max_depth);

/// Only a belt, which may touch the ground blade. Throws as readMesh.
ToolAssembly beltAlone(const std::filesystem::path& belt, double max_depth);

/// The tool of a tool file (tool_file.h); `max_depth` (mm) is for parts that have none of their own. The
/// grinding part is the part in the first row of "allowed" for "ground"; kNoPart if no row has it. Throws as
/// readToolFile, and std::runtime_error naming the tool file and the key of a mesh that cannot be read.
ToolAssembly toolOf(const std::filesystem::path& tool_file, double max_depth);

/// The greatest blade number in the rules' tables; 0 if they have none.
int greatestBladeNamed(const VerdictRules& rules);

}  // namespace octoblisk::demos
