#include "report/replay_files.h"

#include <stdexcept>
#include <string>
#include <string_view>

#include "io/embedded_file.h"
#include "io/new_file.h"
#include "report/run_glb.h"
#include "report/vtk_file.h"

// The page, made by report/web (./dev web), with a placeholder for the run.
OCTOBLISK_EMBED(octoblisk_replay_page, OCTOBLISK_REPLAY_PAGE);

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

namespace {

constexpr std::string_view kPlaceOfRun = "@@RUN@@";

}  // namespace

void writeReplayPage(const Replay& replay, const ReplayMeshes& meshes, const std::filesystem::path& file,
                     const ReplayLimits& limits) {
  const std::string_view page = OCTOBLISK_EMBEDDED(octoblisk_replay_page);
  const std::size_t place = page.find(kPlaceOfRun);
  if (place == std::string_view::npos) throw std::logic_error("the page has no placeholder for the run");
  std::string text(page.substr(0, place));
  text += replayJson(replay, meshes, limits);
  text += page.substr(place + kPlaceOfRun.size());
  writeFile(file, text);
}

}  // namespace octoblisk::demos
