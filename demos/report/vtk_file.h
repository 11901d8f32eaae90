// The numbers of a replay for ParaView: legacy VTK files.
#pragma once

#include <filesystem>
#include <string>

#include "report/replay.h"

namespace octoblisk::demos {

/// POLYDATA of a vertex for each contact (mm, in the blisk's frame), with point data "pose", "verdict",
/// "part", "blade", "depth_mm" and normals; its title tells which number stands for which verdict and part.
/// Of the track of the index.
std::string contactsVtk(const Replay& replay, std::size_t track = 0);

/// POLYDATA of a line through the tool's origin at each pose, with point data "pose", "verdict" and each
/// series of the track (NaN: none).
std::string pathVtk(const Replay& replay, std::size_t track = 0);

/// Writes contacts.vtk and path.vtk of the first track. Throws std::runtime_error naming a file that cannot
/// be written.
void writeVtk(const Replay& replay, const std::filesystem::path& contacts, const std::filesystem::path& path);

}  // namespace octoblisk::demos
