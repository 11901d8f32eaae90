// octoblisk inspect: tells the state of a mesh, and closes its planar holes.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

#include "command_line/help.h"
#include "command_line/options.h"
#include "command_line/terminal_watch.h"
#include "command_line/units_option.h"
#include "commands/commands.h"
#include "io/mesh_file.h"
#include "io/new_file.h"
#include "io/whole_files.h"
#include "models/shared_tree.h"
#include "render/mesh_state_picture.h"
#include "report/inspection_report.h"

namespace octoblisk::demos {
namespace {

struct InspectRequest {
  std::string mesh;
  std::string units;            // empty: the file's
  std::string picture, closed;  // empty: none
  bool json = false;
};

ClosedReport closedReport(const TriangleMesh& closed, ClosedMesh source, const std::string& file) {
  const auto tree = treeOf(closed);
  return {file, std::move(source.added), std::move(source.refused), inspect(octoblisk::Surface(*tree))};
}

int inspectFile(const InspectRequest& request) {
  for (const std::string& out : {request.picture, request.closed}) {
    if (!out.empty()) requireNotRead(out, {request.mesh});
  }
  if (!request.closed.empty()) requireMeshFormat(request.closed);
  const TriangleMesh mesh = readMesh(request.mesh);
  const auto tree = treeOf(request.units.empty() ? mesh : inMillimetres(mesh, request.units, request.mesh));
  const octoblisk::Surface surface(*tree);
  InspectionReport report{.file = request.mesh,
                          .unit = request.units.empty() ? "" : "mm",
                          .size = 2.0 * tree->mesh().bounds().halfExtents(),
                          .found = inspect(surface)};
  WholeFiles files;
  if (!request.closed.empty()) {
    ClosedMesh closed = closeHoles(surface);
    writeMesh(files.add(request.closed), {mesh.vertices(), closed.mesh.triangles()});  // in the file's unit
    const TriangleMesh written = closed.mesh;
    report.closed = closedReport(written, std::move(closed), request.closed);
  }
  if (!request.picture.empty()) {
    writePngWatched(meshStatePicture(surface, report.found, report.unit),
                    files.add(request.picture).string());
  }
  files.finish();
  std::cout << (request.json ? inspectionJson(report) : inspectionText(report));
  if (!request.picture.empty() && !request.json) std::cout << "Picture: " << request.picture << '\n';
  return report.isSolid() ? 0 : 1;
}

}  // namespace

void addInspectCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "inspect");
  const auto request = std::make_shared<InspectRequest>();
  addFile(command, "MESH", request->mesh, "Mesh file: .stl, .obj or .ply")->required();
  addUnitsOption(
      command, request->units,
      "Length unit of the mesh: mm, m, in, or auto, which selects the unit by the mesh's size. Results "
      "are then in mm. Default: results are in the unit of the file");
  command.add_flag("--json", request->json,
                   "Print one JSON object, with all holes and the first ten places of each other defect");
  addFile(command, "--picture", request->picture,
          "PNG file to write: the mesh with holes, cracks, T-junctions, sheets and triangles that face "
          "inward or intersect, in colours");
  addFile(command, "--close", request->closed,
          "Mesh file to write: the mesh with its planar holes closed, in the unit of the input. The "
          "extension selects the format: .stl (binary), .obj or .ply (binary)");
  command.callback([request, &exit_code] { exit_code = inspectFile(*request); });
}

}  // namespace octoblisk::demos
