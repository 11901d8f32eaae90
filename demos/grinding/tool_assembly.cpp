#include "grinding/tool_assembly.h"

#include <algorithm>
#include <stdexcept>

#include "grinding/tool_file.h"
#include "models/embedded_assets.h"
#include "models/outward_mesh.h"
#include "models/shared_tree.h"

namespace octoblisk::demos {

ToolAssembly builtInTool(double max_depth) {
  ToolAssembly tool;
  tool.rules.max_depth = max_depth;
  for (EmbeddedPart& part : embeddedBeltGrinder()) {
    tool.parts.push_back({std::move(part.name), treeOf(std::move(part.mesh))});
  }
  return tool;
}

ToolAssembly beltAlone(const std::filesystem::path& belt, double max_depth) {
  ToolAssembly tool;
  tool.rules.max_depth = max_depth;
  tool.parts.push_back({"belt", treeOf(readOutward(belt, tool.notes))});
  return tool;
}

ToolAssembly toolOf(const std::filesystem::path& tool_file, double max_depth) {
  const ToolFile file = readToolFile(tool_file);
  ToolAssembly tool;
  for (std::size_t part = 0; part < file.parts.size(); ++part) {
    const auto& [name, mesh, own_depth, belt_speed] = file.parts[part];
    try {
      tool.parts.push_back({name, treeOf(readOutward(mesh, tool.notes)), belt_speed});
    } catch (const std::exception& error) {
      throw std::runtime_error(tool_file.string() + ": parts[" + std::to_string(part) +
                               "].mesh: " + error.what());
    }
    tool.rules.max_depths.push_back(own_depth.value_or(max_depth));
  }
  tool.rules.max_depth = max_depth;
  tool.rules.allowed = file.allowed;
  tool.rules.margins = file.margins;
  const auto grinds = std::ranges::find(file.allowed, BladeChoice::Kind::ground,
                                        [](const AllowedPair& pair) { return pair.blade.kind; });
  tool.rules.grinding_part = grinds == file.allowed.end() ? kNoPart : grinds->part.value_or(0);
  return tool;
}

int greatestBladeNamed(const VerdictRules& rules) {
  int greatest = 0;
  for (const AllowedPair& pair : rules.allowed) greatest = std::max(greatest, pair.blade.number);
  for (const PairMargin& row : rules.margins) greatest = std::max(greatest, row.blade.number);
  return greatest;
}

}  // namespace octoblisk::demos
