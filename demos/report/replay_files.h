// The files in which a replay is told: for the browser, for glTF's viewers, for ParaView.
#pragma once

#include <filesystem>

#include "io/whole_files.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// Their names, without a folder.
inline constexpr const char* kReplayFiles[] = {"report.html", "run.glb", "contacts.vtk", "path.vtk"};

/// Adds report.html, run.glb, contacts.vtk and path.vtk of the folder to `files`. Throws std::runtime_error
/// naming a file that cannot be written.
void writeReplayFiles(const Replay& replay, const std::filesystem::path& folder, WholeFiles& files);

/// "To look at: OUT/report.html, …": a line for people.
std::string tellReplayFiles(const std::filesystem::path& folder);

}  // namespace octoblisk::demos
