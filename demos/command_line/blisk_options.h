// The options of a blisk's mesh: --blisk, its --axis, and --convex, the convex side of its blades.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "command_line/grinder_input.h"
#include "models/blade_anatomy.h"
#include "models/blade_region.h"
#include "models/blisk_axis.h"

namespace octoblisk::demos {

/// Adds `--blisk FILE` and `--axis x,y,z[,px,py,pz]`; both texts are stored as they are given.
void addBliskOptions(CLI::App& command, std::string& blisk, std::string& axis);

/// The blisk of a mesh, about the axis in the text of --axis, or about the axis found from the mesh if the
/// text is empty. Throws std::runtime_error with a one-line message that begins with the mesh's name if the
/// mesh is not a blisk, and std::invalid_argument naming the option if its text is not an axis.
BliskFound bliskAbout(const std::string& axis, const TriangleMesh& mesh, const std::string& mesh_name);

/// Adds `--convex forward|backward`; the text is empty if the option is not given.
void addConvexOption(CLI::App& command, std::string& convex);

/// Calls findAnatomy. Its exceptions become std::runtime_error with a message that begins with the mesh's
/// name.
BliskAnatomy anatomyOf(const TriangleMesh& blisk, const BladesFound& blades, const std::string& mesh_name);

/// The convex side, as given or as found. Throws std::runtime_error with a one-line message that begins with
/// the mesh's name if it is neither given nor found.
BladeSide convexSide(const std::string& convex, const BliskAnatomy& anatomy, const std::string& mesh_name);

/// The region that is called convex, concave, leading or trailing. Throws as convexSide.
BladeRegion regionNamed(const std::string& side, const std::string& convex, const BliskAnatomy& anatomy,
                        const std::string& mesh_name);

/// The convex side of a grinder's blisk; none if it is neither given nor found.
std::optional<BladeSide> convexSideOf(const std::string& convex, const GrinderInput& input);

}  // namespace octoblisk::demos
