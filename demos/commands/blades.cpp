// octoblisk blades: finds the axis, blades, sides, edges and channels of a blisk's mesh.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>

#include "command_line/blisk_options.h"
#include "command_line/grinder_input.h"
#include "command_line/help.h"
#include "command_line/options.h"
#include "command_line/terminal_watch.h"
#include "command_line/units_option.h"
#include "commands/commands.h"
#include "io/new_file.h"
#include "io/whole_files.h"
#include "models/blade_anatomy.h"
#include "models/blisk_axis.h"
#include "models/embedded_assets.h"
#include "render/blade_picture.h"

namespace octoblisk::demos {
namespace {

struct BladesRequest {
  std::string blisk, axis, convex, units;  // empty: the built-in blisk, found, found, mm
  std::string out;
  bool no_picture = false;
};

std::string textOf(const Vec3& v) {
  std::ostringstream text;
  text << '(' << v.x() << ", " << v.y() << ", " << v.z() << ')';
  return text.str();
}

void writeBlades(const BliskFound& found, const BliskAnatomy& anatomy, BladeSide convex_side,
                 const std::filesystem::path& file) {
  const Pose blisk_in_mesh = found.mesh_in_blisk.inverse();
  std::ostringstream stream;
  stream.precision(9);
  stream << "blade,angle_deg,triangles,convex_area_mm2,concave_area_mm2,tip_area_mm2,camber_chords";
  for (const char* edge : {"leading", "trailing"}) {
    for (const char* end : {"root", "tip"}) {
      for (const char axis : {'x', 'y', 'z'}) stream << ',' << edge << '_' << end << '_' << axis << "_mm";
    }
  }
  stream << ",channel_from_side,channel_to_blade,channel_to_side,channel_width_mm\n";
  const bool forward_convex = convex_side == BladeSide::forward;
  for (std::size_t k = 0; k < anatomy.blades.size(); ++k) {
    const BladeAnatomy& blade = anatomy.blades[k];
    const double convex = forward_convex ? blade.forward_area : blade.backward_area;
    const double concave = forward_convex ? blade.backward_area : blade.forward_area;
    stream << k + 1 << ',' << blade.angle * 180.0 / std::numbers::pi << ',' << blade.triangles << ','
           << convex << ',' << concave << ',' << blade.tip_area << ','
           << (forward_convex ? blade.camber : -blade.camber);
    for (const auto* edge : {&blade.leading, &blade.trailing}) {
      for (const Vec3& end : {edge->front(), edge->back()}) {
        const Vec3 in_mesh = blisk_in_mesh * end;
        stream << ',' << in_mesh.x() << ',' << in_mesh.y() << ',' << in_mesh.z();
      }
    }
    stream << ',' << (forward_convex ? "convex" : "concave") << ',' << (k + 1) % anatomy.blades.size() + 1
           << ',' << (forward_convex ? "concave" : "convex") << ',' << blade.channel_width << '\n';
  }
  writeFile(file, stream.str());
}

void print(const BladesRequest& request, const BliskFound& found, const BliskAnatomy& anatomy,
           BladeSide convex_side) {
  const BladesFound& blades = found.blades;
  const auto of_hub = std::ranges::count(anatomy.sides.blade_of_triangle, 0);
  std::cout << blades.count << " blades about the axis " << textOf(found.axis.direction) << " through "
            << textOf(found.axis.point) << (request.axis.empty() ? ", found" : ", as given")
            << "; rotated by one pitch, the blades match the mesh within " << found.repeat_error << " mm\n";
  std::cout << (blades.shrouded ? "Hub and shroud: " : "Hub: ") << of_hub << " triangles, hub up to radius "
            << blades.root_radius << " mm; blades up to " << blades.tip_radius << " mm\n";
  const auto by_width = [](const BladeAnatomy& a, const BladeAnatomy& b) {
    return a.channel_width < b.channel_width;
  };
  const auto [narrow, wide] = std::minmax_element(anatomy.blades.begin(), anatomy.blades.end(), by_width);
  const bool forward_convex = convex_side == BladeSide::forward;
  std::cout << "Convex sides face "
            << (forward_convex ? "forward, towards greater" : "backward, towards lesser") << " angles"
            << (request.convex.empty() ? "" : ", as given")
            << "; leading edges are assumed to be where the axis begins (reverse it with --axis)\n";
  std::cout << "Channels, from a blade's " << (forward_convex ? "convex" : "concave")
            << " side to the next blade's " << (forward_convex ? "concave" : "convex")
            << " side: " << narrow->channel_width << " to " << wide->channel_width << " mm at mid height\n";
}

int findAndPrint(const BladesRequest& request) {
  const std::string name = request.blisk.empty() ? "the built-in blisk" : request.blisk;
  const TriangleMesh mesh =
      request.blisk.empty() ? embeddedBlisk() : readUsersMesh(request.blisk, request.units);
  const BliskFound found = bliskAbout(request.axis, mesh, name);
  const TriangleMesh blisk = moved(mesh, found.mesh_in_blisk);
  const BliskAnatomy anatomy = anatomyOf(blisk, found.blades, name);
  const BladeSide convex_side = convexSide(request.convex, anatomy, name);

  const std::filesystem::path out = request.out;
  makeFolder(request.out);
  WholeFiles files;
  writeBlades(found, anatomy, convex_side, files.add(out / "blades.csv"));
  if (!request.no_picture) {
    writePngWatched(bladePicture(blisk, found, anatomy, convex_side), files.add(out / "blades.png").string());
  }
  files.finish();
  print(request, found, anatomy, convex_side);
  std::cout << "Table: " << (out / "blades.csv").string() << '\n';
  if (!request.no_picture) std::cout << "Picture: " << (out / "blades.png").string() << '\n';
  return 0;
}

}  // namespace

void addBladesCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "blades");
  const auto request = std::make_shared<BladesRequest>();
  addBliskOptions(command, request->blisk, request->axis);
  addUnitsOption(command, request->units);
  addConvexOption(command, request->convex);
  addOut(command, request->out, "Folder for blades.csv and blades.png; created if missing", "DIR");
  command.add_flag("--no-picture", request->no_picture, "Do not write the picture");
  command.callback([request, &exit_code] { exit_code = findAndPrint(*request); });
}

}  // namespace octoblisk::demos
