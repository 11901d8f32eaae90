// The option by which a user tells which sides of the blades are convex.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "command_line/grinder_input.h"
#include "models/blade_anatomy.h"
#include "models/blisk_axis.h"

namespace octoblisk::demos {

/// Adds `--convex forward|backward`; the text is empty where it is not given.
void addConvexOption(CLI::App& command, std::string& convex);

/// findAnatomy. What it throws becomes a std::runtime_error that begins with the mesh's name.
BliskAnatomy anatomyOf(const TriangleMesh& blisk, const BliskFound& found, const std::string& mesh_name);

/// The convex side, as told or as found. Throws std::runtime_error in one line that begins with the mesh's
/// name where it is neither.
BladeSide convexSide(const std::string& convex, const BliskAnatomy& anatomy, const std::string& mesh_name);

/// The same of a grinder's blisk; none where it is neither.
std::optional<BladeSide> convexSideOf(const std::string& convex, const GrinderInput& input);

}  // namespace octoblisk::demos
