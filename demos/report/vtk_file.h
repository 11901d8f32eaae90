// Writes the numbers of a replay as legacy VTK files for ParaView.
#pragma once

#include <filesystem>
#include <string>

#include "report/replay.h"

namespace octoblisk::demos {

/// POLYDATA with a vertex per contact of the given track (mm, in the blisk's frame), with point data "pose",
/// "verdict", "part", "blade", "depth_mm" and normals. The title lists the numbers of the verdicts and parts.
std::string contactsVtk(const Replay& replay, std::size_t track = 0);

/// POLYDATA with a line through the tool's origin at each pose, with point data "pose", "verdict" and each
/// series of the track (NaN: none).
std::string pathVtk(const Replay& replay, std::size_t track = 0);

/// Writes contacts.vtk and path.vtk for the first track. Throws std::runtime_error naming a file that cannot
/// be written.
void writeVtk(const Replay& replay, const std::filesystem::path& contacts, const std::filesystem::path& path);

}  // namespace octoblisk::demos
