// The options --blisk and --axis: the mesh of a blisk, and its axis.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "models/blisk_axis.h"

namespace octoblisk::demos {

/// Adds `--blisk FILE` and `--axis x,y,z[,px,py,pz]`; both texts are stored as they are given.
void addBliskOptions(CLI::App& command, std::string& blisk, std::string& axis);

/// The blisk of a mesh, about the axis in the text of --axis, or about the axis found from the mesh if the
/// text is empty. Throws std::runtime_error with a one-line message that begins with the mesh's name if the
/// mesh is not a blisk, and std::invalid_argument naming the option if its text is not an axis.
BliskFound bliskAbout(const std::string& axis, const TriangleMesh& mesh, const std::string& mesh_name);

}  // namespace octoblisk::demos
