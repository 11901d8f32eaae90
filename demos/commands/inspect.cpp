// octoblisk inspect: tells the defects of a mesh, what follows from them, and closes planar holes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "command_line/option_checks.h"
#include "command_line/picture_bar.h"
#include "command_line/print_message.h"
#include "command_line/subcommand_help.h"
#include "commands/commands.h"
#include "io/mesh_file.h"
#include "models/shared_tree.h"
#include "octoblisk/inspection.h"
#include "render/mesh_state_picture.h"

namespace octoblisk::demos {
namespace {

struct InspectRequest {
  std::string mesh, picture, closed;  // empty: no picture, not closed
  bool json = false;
};

/// A kind of defect and its places.
struct DefectKind {
  const char* name;  ///< in JSON
  const char* one;
  const char* many;
  const std::vector<DefectPlace>* places;
};

std::vector<DefectKind> kindsOf(const MeshInspection& found) {
  return {{"t_junctions", "corner lies", "corners lie", &found.t_junctions},
          {"copies", "triangle is", "triangles are", &found.copies},
          {"zero_area", "triangle has", "triangles have", &found.zero_area},
          {"shared_edges", "edge belongs", "edges belong", &found.shared_edges},
          {"opposed_edges", "edge joins", "edges join", &found.opposed_edges},
          {"intersecting", "triangle intersects", "triangles intersect", &found.intersecting},
          {"inward", "triangle faces", "triangles face", &found.inward},
          {"inner", "triangle is", "triangles are", &found.inner},
          {"sheets", "triangle bounds", "triangles bound", &found.sheets}};
}

/// What comes after the words of DefectKind.
const char* restOf(const std::string& name) {
  if (name == "t_junctions") return " on the edge of another triangle (T-junctions)";
  if (name == "copies") return " a copy of another one";
  if (name == "zero_area") return " no area";
  if (name == "shared_edges") return " to more than two triangles";
  if (name == "opposed_edges") return " triangles that face against each other";
  if (name == "intersecting") return " others";
  if (name == "inward") return " into the solid";
  if (name == "inner") return " inside the solid, where parts overlap";
  return " no solid: holes are near, or both sides are outside";
}

constexpr std::pair<GapKind, const char*> kGapKinds[] = {{GapKind::hole, "hole"},
                                                         {GapKind::turned, "turned"},
                                                         {GapKind::t_junction, "t_junction"},
                                                         {GapKind::crack, "crack"},
                                                         {GapKind::inner, "inner"}};

std::string placeText(const Vec3& v) {
  std::ostringstream text;
  text << '(' << v.x() << ' ' << v.y() << ' ' << v.z() << ')';
  return text.str();
}

nlohmann::json jsonOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

const char* nameOf(GapKind kind) {
  for (const auto& [known, name] : kGapKinds) {
    if (known == kind) return name;
  }
  return "";
}

nlohmann::json jsonOf(const MeshInspection& found) {
  nlohmann::json all = {{"triangles", found.triangles},   {"components", found.components},
                        {"shells", found.shells},         {"hollows", found.hollows},
                        {"is_closed", found.is_closed},   {"is_solid", found.isSolid()},
                        {"why_not_solid", whyNotSolid(found)}};
  all["volume"] = found.mass.is_solid ? nlohmann::json(found.mass.volume) : nlohmann::json();
  nlohmann::json& gaps = all["gaps"] = nlohmann::json::array();
  for (const MeshGap& gap : found.gaps) {
    gaps.push_back({{"kind", nameOf(gap.kind)},
                    {"edges", gap.edges},
                    {"triangle", gap.triangle},
                    {"length", gap.length},
                    {"width", gap.width},
                    {"center", jsonOf(gap.center)},
                    {"area", gap.area},
                    {"off_plane", gap.off_plane},
                    {"is_planar", gap.is_planar}});
  }
  for (const DefectKind& kind : kindsOf(found)) {
    constexpr std::size_t kMost = 100;
    nlohmann::json& of_kind = all[kind.name] = {{"count", kind.places->size()}, {"places", nlohmann::json::array()}};
    for (std::size_t i = 0; i < std::min(kMost, kind.places->size()); ++i) {
      const DefectPlace& place = (*kind.places)[i];
      of_kind["places"].push_back({{"triangle", place.triangle}, {"position", jsonOf(place.position)}});
    }
  }
  return all;
}

void printGaps(const MeshInspection& found) {
  for (const MeshGap& gap : found.gaps) {
    if (gap.kind != GapKind::hole) continue;
    std::cout << "  a hole with " << gap.edges << " edges at " << placeText(gap.center) << ", beside triangle "
              << gap.triangle << (gap.is_planar ? ", planar" : "") << '\n';
  }
  if (const std::size_t turned = found.count(GapKind::turned); turned > 0)
    std::cout << "  " << turned << " places where triangles face against their neighbours\n";
  if (const std::size_t cracks = found.count(GapKind::crack); cracks > 0) {
    double width = 0.0;
    for (const MeshGap& gap : found.gaps) {
      if (gap.kind == GapKind::crack) width = std::max(width, gap.width);
    }
    std::cout << "  " << cracks << (cracks == 1 ? " crack" : " cracks") << ", at most " << width << " wide\n";
  }
}

void print(const MeshInspection& found, const Aabb& bounds, const std::string& file) {
  const Vec3 size = 2.0 * bounds.halfExtents();
  std::cout << file << ": " << found.triangles << " triangles, " << size.x() << " x " << size.y() << " x "
            << size.z() << ", " << found.components << (found.components == 1 ? " component" : " components")
            << '\n';
  const std::string why = whyNotSolid(found);
  std::cout << (why.empty() ? "The mesh bounds a solid and faces outward." : why) << '\n';
  printGaps(found);
  for (const DefectKind& kind : kindsOf(found)) {
    const std::size_t count = kind.places->size();
    if (count == 0) continue;
    const DefectPlace& first = kind.places->front();
    std::cout << "  " << count << ' ' << (count == 1 ? kind.one : kind.many) << restOf(kind.name)
              << (count == 1 ? ": " : "; the first: ") << "triangle " << first.triangle << " at "
              << placeText(first.position) << '\n';
  }
  if (found.mass.is_solid) {
    std::cout << "Volume: " << found.mass.volume << "; inertia and depths are exact\n";
  } else {
    std::cout << "Inertia: that of the bounding box. "
              << (found.isAnywhereSolid() ? "Depths are known where triangles bound the solid.\n"
                                          : "Nothing is inside, so there are no depths and no margin.\n");
  }
}

/// Returns whether the written mesh bounds a solid and faces outward.
bool writeClosed(const octoblisk::Surface& surface, const std::string& file) {
  const ClosedMesh closed = closeHoles(surface);
  writeMesh(file, closed.mesh);
  for (const HoleCap& cap : closed.added) {
    std::cout << "Closed a hole with " << cap.edges << " edges at " << placeText(cap.center) << " by "
              << cap.triangles << " triangles\n";
  }
  for (const MeshGap& gap : closed.refused) {
    warnOf(file, "a hole with " + std::to_string(gap.edges) + " edges at " + placeText(gap.center) +
                     (gap.is_planar ? " stays open: its outline crosses itself"
                                    : " stays open: it is not planar"));
  }
  std::cout << "Mesh: " << file << '\n';
  const auto tree = treeOf(closed.mesh);
  return inspect(octoblisk::Surface(*tree)).isSolid();
}

int inspectMesh(const InspectRequest& request) {
  const auto tree = treeOf(readMesh(request.mesh));
  const octoblisk::Surface surface(*tree);
  const MeshInspection found = inspect(surface);
  if (request.json) {
    std::cout << jsonOf(found).dump(2) << '\n';
  } else {
    print(found, tree->mesh().bounds(), request.mesh);
  }
  if (!request.picture.empty()) {
    writePngWatched(meshStatePicture(surface, found), request.picture);
    if (!request.json) std::cout << "Picture: " << request.picture << '\n';
  }
  bool is_solid = found.isSolid();
  if (!request.closed.empty()) is_solid = writeClosed(surface, request.closed);
  return is_solid ? 0 : 1;
}

}  // namespace

void addInspectCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "inspect");
  const auto request = std::make_shared<InspectRequest>();
  command.add_option("mesh", request->mesh, "The mesh: STL, PLY, OBJ or another format that assimp reads")
      ->type_name("FILE")
      ->required()
      ->check(notEmpty());
  command.add_flag("--json", request->json, "Print JSON instead of text; of each kind of defect, at most 100 places");
  command.add_option("--picture", request->picture, "Draw the mesh and its defects to this PNG file")
      ->type_name("FILE")
      ->check(notEmpty());
  command.add_option("--close", request->closed, "Write the mesh with its planar holes closed to this file")
      ->type_name("FILE")
      ->check(notEmpty());
  command.get_option("--json")->excludes("--close");
  command.callback([request, &exit_code] { exit_code = inspectMesh(*request); });
}

}  // namespace octoblisk::demos
