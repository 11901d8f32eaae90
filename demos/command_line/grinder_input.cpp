#include "command_line/grinder_input.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "command_line/blisk_options.h"
#include "command_line/options.h"
#include "command_line/print_message.h"
#include "command_line/units_option.h"
#include "grinding/grinding_run.h"
#include "io/csv_table.h"
#include "io/mesh_file.h"
#include "io/new_file.h"
#include "io/number_text.h"
#include "io/quoted_text.h"
#include "io/table_name.h"
#include "models/belt_grinder.h"
#include "models/blisk_axis.h"
#include "models/defect_words.h"
#include "models/embedded_assets.h"
#include "models/length_limit.h"
#include "models/outward_mesh.h"
#include "models/shared_tree.h"
#include "study/node_inputs.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {
namespace {

constexpr int kMaxBladesOfBlisk = 10'000;
constexpr double kMaxMargin = 100.0;  // mm

void printWarnings(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) printMessage("warning: " + note);
}

const ToolPart& largestPart(const ToolAssembly& tool) {
  return *std::ranges::max_element(tool.parts, {},
                                   [](const ToolPart& part) { return sizeOf(part.tree->mesh()); });
}

void readInMillimetres(const GrinderFiles& files, ToolAssembly& tool) {
  if (files.tool_units.empty()) return;
  if (files.tool.empty() && files.belt.empty()) {
    throw std::invalid_argument(
        "--tool-units: the built-in tool is in mm; the option needs --tool or --belt");
  }
  const std::string units =
      unitsFor(files.tool_units, sizeOf(largestPart(tool).tree->mesh()), files.toolName());
  if (units == "mm") return;
  for (ToolPart& part : tool.parts) {
    part.tree = treeOf(inMillimetres(part.tree->mesh(), units, files.toolName()));
  }
}

/// Replaces "auto" with the unit found from the blisk's size. The obstacles share the blisk's frame, and so
/// its unit.
GrinderFiles withUnitsFound(GrinderFiles files) {
  if (files.units != "auto") return files;
  files.units =
      files.blisk.empty() ? "mm" : unitsFor(files.units, sizeOf(readMesh(files.blisk)), files.blisk);
  return files;
}

ToolAssembly toolOfFiles(const GrinderFiles& files) {
  ToolAssembly tool = !files.tool.empty()   ? toolOf(files.tool, files.max_depth)
                      : !files.belt.empty() ? beltAlone(files.belt, files.max_depth)
                                            : builtInTool(files.max_depth);
  printWarnings(tool.notes);
  readInMillimetres(files, tool);
  return tool;
}

TriangleMesh bliskOfFiles(const GrinderFiles& files) {
  return files.blisk.empty() ? embeddedBlisk() : readUsersMesh(files.blisk, files.units);
}

/// Reads "mesh" or "mesh,name". The default name is the file's, without its extension.
Fixture fixtureOf(const std::string& text, const std::string& units) {
  std::filesystem::path file = text;
  std::string name = file.stem().string();
  if (const std::size_t comma = text.rfind(',');
      comma != std::string::npos && !std::filesystem::exists(file)) {
    file = text.substr(0, comma);
    name = text.substr(comma + 1);
  }
  if (!isTableName(name) || (name.front() >= '0' && name.front() <= '9')) {
    throw std::invalid_argument("--obstacle " + text + ": " + inQuotes(name) + ": " + kTableNameRule +
                                ", and must not begin with a digit: give a name as MESH,NAME");
  }
  return {name, treeOf(readUsersMesh(file, units))};
}

std::vector<Fixture> fixturesOf(const GrinderFiles& files) {
  std::vector<Fixture> fixtures;
  for (const std::string& text : files.obstacles) {
    Fixture fixture = fixtureOf(text, files.units);
    if (std::ranges::find(fixtures, fixture.name, &Fixture::name) != fixtures.end()) {
      throw std::invalid_argument("--obstacle " + text + ": two obstacles have the name " +
                                  inQuotes(fixture.name) + ": give another name as MESH,NAME");
    }
    const MeshInspection found = defectsOf(*fixture.tree, files.threads);
    if (!found.is_closed)
      warnOf(text, openText(found) + ": the obstacle is an open mesh, so no part is ever inside it");
    fixtures.push_back(std::move(fixture));
  }
  return fixtures;
}

void findBladesOf(const GrinderFiles& files, const TriangleMesh& mesh, GrinderInput& input) {
  try {
    BliskFound found = bliskAbout(files.axis, mesh, files.bliskName());
    input.mesh_in_blisk = found.mesh_in_blisk;
    input.blades = std::move(found.blades);
  } catch (const std::runtime_error&) {
    if (!files.axis.empty()) throw;
    input.blades = findBlades(mesh);
  }
}

/// A closed blisk opens only at the ends of its channels: grinds near one end, with the arm out of it.
void leaveDownstream(GrindingPathOptions& options) {
  options.arm = PathArm::downstream;
  options.chord_from = 0.7;
  options.span_from = 0.75;
  options.span_to = 0.35;
}

void requireUnitsFit(const GrinderFiles& files, const TriangleMesh& blisk, const ToolAssembly& tool) {
  constexpr double kGreatestRatio = 25.0;
  if (files.units == "mm") return;  // the user accepts the sizes as they are
  const ToolPart& part = largestPart(tool);
  requireSizesFit(files.bliskName(), sizeOf(blisk), part.name, sizeOf(part.tree->mesh()), kGreatestRatio,
                  "--tool-units");
}

void requireBladesThere(const GrinderFiles& files, const GrinderInput& input) {
  const int blades = input.blades.count;
  const std::string there = ": the blisk has " + std::to_string(blades) + " blades, numbered from 1";
  if (files.ground_blade && (*files.ground_blade < 1 || *files.ground_blade > blades)) {
    throw std::invalid_argument("--ground-blade " + std::to_string(*files.ground_blade) + there);
  }
  if (files.ground_blade && input.tool.rules.grinding_part == kNoPart) {
    throw std::invalid_argument("--ground-blade: no part may touch that blade: " + files.tool +
                                " has no row of \"allowed\" with \"ground\"");
  }
  if (const int named = greatestBladeNamed(input.tool.rules); named > blades) {
    throw std::invalid_argument(files.tool + ": blade " + std::to_string(named) + there);
  }
}

}  // namespace

TriangleMesh readUsersMesh(const std::filesystem::path& file, const std::string& units) {
  std::vector<std::string> notes;
  TriangleMesh mesh = readOutward(file, notes);
  printWarnings(notes);
  return inMillimetres(std::move(mesh), units, file);
}

void addGrinderOptions(CLI::App& command, GrinderFiles& files) {
  addBliskOptions(command, files.blisk, files.axis);
  addUnitsOption(command, files.units,
                 "Length unit of the meshes of blisk and obstacles: mm, m, in, or auto, which selects the "
                 "unit by the blisk's size. Default: mm. Paths and results are in mm");
  addUnitsOption(
      command, files.tool_units,
      "Length unit of the meshes of --belt or --tool; auto selects it by the largest mesh. Default: mm",
      "--tool-units");
  CLI::Option* const belt = addFile(
      command, "--belt", files.belt,
      "Mesh file of a belt, checked without wheels and arm (mm, contact wheel at the origin, arm along "
      "+x). Default: the built-in grinder with belt, wheels and arm");
  addFile(command, "--tool", files.tool,
          "JSON file with a tool's parts, what each may touch and the distance that it must keep "
          "from the rest; 'octoblisk make grinder' writes an example")
      ->excludes(belt);
  addOption(command, "--obstacle", files.obstacles, "MESH[,NAME]", notEmpty(),
            "Mesh file of a fixed body that the tool must not touch, for example a clamp or a table, in "
            "the blisk's frame and unit; may be repeated")
      ->allow_extra_args(false);
  addOut(command, files.out, "Folder to write to; created if missing", "DIR");
  addOption(command, "--ground-blade", files.ground_blade, "N", wholeNumberFrom(1, kMaxBladesOfBlisk),
            "Number of the blade to be ground. Default: 1, or with --path the blade that the belt "
            "touches at the greatest number of poses");
  addOption(command, "--max-depth", files.max_depth, "MM", numberFrom(0.0, kMaxLength),
            "Greatest penetration depth of belt and ground blade: how deep the deepest point of either is "
            "in the other. A tool file may give a depth for each part");
  addOption(command, "--threads", files.threads, "N", wholeNumberFrom(0, 1024),
            "Number of threads; 0: all cores of the machine. The answers are the same for any number");
}

void addMarginOption(CLI::App& command, double& margin) {
  addOption(
      command, "--margin", margin, "MM", numberFrom(0.0, kMaxMargin),
      "Clearance that all parts must keep, except the belt from the ground blade; 0: they must not touch");
}

GrinderInput readGrinder(const GrinderFiles& files_asked) {
  const GrinderFiles files = withUnitsFound(files_asked);
  GrinderInput input;
  input.tool = toolOfFiles(files);
  input.fixtures = fixturesOf(files);
  const auto blisk = std::make_shared<const TriangleMesh>(bliskOfFiles(files));
  requireUnitsFit(files, *blisk, input.tool);
  findBladesOf(files, *blisk, input);
  requireBladesThere(files, input);
  const auto start = std::chrono::steady_clock::now();
  BuildOptions options = files.tree;
  const bool is_clustered = options.partition == PartitionKind::clustering;
  if (!is_clustered) options.part_of_triangle = input.blades.blade_of_triangle;
  input.blisk = std::make_shared<const ClusteredOctree>(ClusteredOctree::build(blisk, options));
  input.tree_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (is_clustered) return input;
  for (ToolPart& part : input.tool.parts) {
    part.tree =
        std::make_shared<const ClusteredOctree>(ClusteredOctree::build(part.tree->sharedMesh(), files.tree));
  }
  return input;
}

GrinderInput readGrinder(const GrinderFiles& files_asked, Ranks& ranks) {
  GrinderFiles files;
  GrinderInput input;
  ranks.together([&] {
    files = withUnitsFound(files_asked);
    input.tool = toolOfFiles(files);
    input.fixtures = fixturesOf(files);
  });
  input.blisk =
      std::make_shared<const ClusteredOctree>(treeOncePerNode(ranks, [&] { return bliskOfFiles(files); }));
  ranks.together([&] {
    requireUnitsFit(files, input.blisk->mesh(), input.tool);
    findBladesOf(files, input.blisk->mesh(), input);
    requireBladesThere(files, input);
  });
  return input;
}

GrindingJob jobWithoutPath(const GrinderFiles& files, const GrinderInput& input) {
  GrindingJob job;
  job.blisk = input.blisk;
  job.mesh_in_blisk = input.mesh_in_blisk;
  job.blades = input.blades;
  job.parts = input.tool.parts;
  job.fixtures = input.fixtures;
  job.rules = input.tool.rules;
  job.threads = files.threads;
  return job;
}

std::vector<Pose> builtInPath(const GrinderFiles& files, const GrinderInput& input) {
  if (input.blades.count == 0) {
    throw std::invalid_argument(
        files.bliskName() + ": no blades were found, so there is no built-in path: give a path with --path");
  }
  const BeltParameters belt;
  GrindingPathOptions options;
  options.blade = files.ground_blade.value_or(1);
  options.wheel_radius = belt.contact_wheel_radius + belt.thickness;
  if (input.blades.shrouded) leaveDownstream(options);
  std::vector<Pose> path =
      makeGrindingPath(moved(input.blisk->mesh(), input.mesh_in_blisk), input.blades, options);
  const Pose blisk_in_mesh = input.mesh_in_blisk.inverse();
  for (Pose& pose : path) pose = blisk_in_mesh * pose;
  return path;
}

PathFile readPath(const std::string& file, const ClusteredOctree& blisk) {
  PathFile path = readPathFile(file, blisk);
  constexpr double kFarthest = 1e6;  // mm; no machine reaches so far
  for (std::size_t pose = 0; pose < path.motions.size(); ++pose) {
    if (path.motions[pose].tool_in_blisk.translation.norm() <= kFarthest) continue;
    throw std::runtime_error(
        atLine(file, path.lines[pose].first, "the tool is more than 1e6 mm from the origin"));
  }
  for (const ClUnknown& unknown : path.unknown) {
    warnOf(file, unknown.word + ", first in line " + std::to_string(unknown.line) + ", is ignored");
  }
  if (path.second_tool != 0) {
    warnOf(file, "line " + std::to_string(path.second_tool) +
                     " loads another tool, but every motion is judged with the same tool");
  }
  return path;
}

std::optional<int> groundBladeOf(const GrinderFiles& files, const GrinderInput& input,
                                 const std::vector<Pose>& path, const RunWatch& watch) {
  if (files.ground_blade) return *files.ground_blade;
  if (files.path.empty()) return input.blades.count > 0 ? 1 : 0;
  const std::size_t part = input.tool.rules.grinding_part;
  if (part == kNoPart) return 0;
  return bladeTouchedMost(*input.blisk, *input.tool.parts[part].tree, input.blades.blade_of_triangle, path,
                          files.threads, watch);
}

VerdictRules reachRulesOf(const GrinderFiles& files, const GrinderInput& input, int ground_blade,
                          double margin) {
  const VerdictRules& rules = input.tool.rules;
  requireMarginFits(input, "--margin", margin);
  if (rules.grinding_part == kNoPart) {
    throw std::runtime_error(files.tool +
                             ": allowed: no row has \"blade\": \"ground\"; access, plan and repair need one");
  }
  for (std::size_t row = 0; row < rules.allowed.size(); ++row) {
    const AllowedPair& pair = rules.allowed[row];
    if (pair.blade.kind == BladeChoice::Kind::ground && pair.part == rules.grinding_part) continue;
    throw std::runtime_error(
        files.tool + ": allowed[" + std::to_string(row) +
        "]: access, plan and repair allow only one part to touch, and only the ground blade");
  }
  return {.grinding_part = rules.grinding_part,
          .ground_blade = ground_blade,
          .max_depth = rules.maxDepth(rules.grinding_part),
          .near_miss = margin};
}

void requireNotRead(const GrinderFiles& files, const std::vector<std::string>& tables) {
  std::vector<std::filesystem::path> inputs = {files.path, files.blisk, files.belt, files.tool};
  for (const std::string& text : files.obstacles) {
    inputs.emplace_back(text);
    inputs.emplace_back(text.substr(0, text.rfind(',')));
  }
  for (const std::string& table : tables) {
    requireNotRead((std::filesystem::path(files.out) / table).string(), inputs);
  }
}

void requireMarginFits(const GrinderInput& input, const std::string& option, double margin) {
  constexpr double kGreatestPart = 0.02;
  const double greatest = kGreatestPart * sizeOf(input.blisk->mesh());
  if (margin <= greatest) return;
  throw std::invalid_argument(option + " " + shortText(margin) + ": must be at most " + shortText(greatest) +
                              " for a blisk of " + shortText(sizeOf(input.blisk->mesh())) + " mm");
}

void warnOfUntouched(const GrinderFiles& files, const GrinderInput& input, int ground_blade) {
  const std::size_t part = input.tool.rules.grinding_part;
  const bool is_found = !files.path.empty() && !files.ground_blade && part != kNoPart;
  if (!is_found || ground_blade != 0 || input.blades.count == 0) return;
  warnOf(files.path,
         "the " + input.tool.parts[part].name +
             " touches no blade at any pose: if it should, give the poses in mm and in the frame of "
             "the blisk's mesh");
}

void warnOfInput(const GrinderFiles& files, const GrinderInput& input) {
  if (input.blades.count == 0) {
    const VerdictRules& rules = input.tool.rules;
    bool may_touch = false;
    for (std::size_t part = 0; part < input.tool.parts.size(); ++part) may_touch |= rules.allows(part, 0);
    warnOf(files.bliskName(), std::string("no blades were found: ") +
                                  (may_touch ? "all of it is hub or shroud"
                                             : "every touch counts as interference with hub or shroud"));
  }
  const MeshInspection found = defectsOf(*input.blisk, files.threads);
  const std::string open = openText(found), inward = inwardText(found);
  std::string text;
  if (!open.empty()) {
    text =
        open +
        ". Near these places the surface does not bound a solid: where the tool touches there, its depth and "
        "verdict are unknown, which counts as interference";
  }
  if (!inward.empty()) {
    text += (open.empty() ? "" : ". ") + inward + ": the normals of contacts there may point into the blisk";
  }
  if (!text.empty()) warnOf(files.bliskName(), text);
}

}  // namespace octoblisk::demos
