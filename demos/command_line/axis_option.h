// The option by which a user tells the axis of a blisk.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "models/blisk_axis.h"

namespace octoblisk::demos {

/// Adds `--axis x,y,z[,px,py,pz]`; the text is left as it is given.
void addAxisOption(CLI::App& command, std::string& axis);

/// The blisk of a mesh, about the axis that the option's text tells, or found where it is empty.
/// Throws std::runtime_error in one line that begins with the mesh's name where there is none, and
/// std::invalid_argument naming the option where its text is no axis.
BliskFound bliskAbout(const std::string& axis, const TriangleMesh& mesh, const std::string& mesh_name);

}  // namespace octoblisk::demos
