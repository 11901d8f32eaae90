// Writes a replay for the browser, for glTF viewers and for ParaView.
#pragma once

#include <filesystem>

#include "io/whole_files.h"
#include "report/replay.h"
#include "report/replay_json.h"

namespace octoblisk::demos {

/// Adds report.html, run.glb, contacts.vtk and path.vtk of the folder to `files`. Throws std::runtime_error
/// naming a file that cannot be written.
void writeReplayFiles(const Replay& replay, const std::filesystem::path& folder, WholeFiles& files);

/// "Report: OUT/report.html; …": one line for the user.
std::string replayFilesText(const std::filesystem::path& folder);

/// Writes the page. Throws std::runtime_error naming a file that cannot be written.
void writeReplayPage(const Replay& replay, const ReplayMeshes& meshes, const std::filesystem::path& file,
                     const ReplayLimits& limits = {});

}  // namespace octoblisk::demos
