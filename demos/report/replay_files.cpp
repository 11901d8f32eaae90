#include "report/replay_files.h"

#include "report/replay_page.h"
#include "report/run_glb.h"
#include "report/vtk_file.h"

namespace octoblisk::demos {

void writeReplayFiles(const Replay& replay, const std::filesystem::path& folder, WholeFiles& files) {
  const ReplayMeshes meshes = replayMeshesOf(replay);
  writeReplayPage(replay, meshes, files.add(folder / "report.html"));
  writeGlb(replay, meshes, files.add(folder / "run.glb"));
  writeVtk(replay, files.add(folder / "contacts.vtk"), files.add(folder / "path.vtk"));
}

std::string replayFilesText(const std::filesystem::path& folder) {
  return "Report: " + (folder / "report.html").string() + "; glTF: " + (folder / "run.glb").string() +
         "; for ParaView: " + (folder / "contacts.vtk").string() + ", " + (folder / "path.vtk").string() +
         "\n";
}

}  // namespace octoblisk::demos
