// The option --axis, the axis of a blisk.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "models/blisk_axis.h"

namespace octoblisk::demos {

/// Adds `--axis x,y,z[,px,py,pz]`; the text is stored as it is given.
void addAxisOption(CLI::App& command, std::string& axis);

/// The blisk of a mesh, about the axis in the option's text, or about the axis found from the mesh if the
/// text is empty. Throws std::runtime_error with a one-line message that begins with the mesh's name if the
/// mesh is not a blisk, and std::invalid_argument naming the option if its text is not an axis.
BliskFound bliskAbout(const std::string& axis, const TriangleMesh& mesh, const std::string& mesh_name);

}  // namespace octoblisk::demos
