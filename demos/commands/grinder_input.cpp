#include "commands/grinder_input.h"

#include <iostream>
#include <stdexcept>

#include "access/pose_judge.h"
#include "commands/option_checks.h"
#include "models/belt_grinder.h"
#include "models/embedded_assets.h"
#include "models/length_limit.h"
#include "models/mesh_file.h"
#include "models/open_edges.h"
#include "models/orientation.h"
#include "models/shared_tree.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {
namespace {

constexpr int kMostBladesOfBlisk = 10'000;
constexpr double kMostMargin = 100.0;  // mm

TriangleMesh readFacingOutward(const std::string& file) {
  TriangleMesh mesh = readMesh(file);
  if (enclosedVolume(mesh) >= 0.0) return mesh;
  std::cout << file << ": its triangles face inward; they are taken turned round\n";
  return turned(mesh);
}

void requireBladeThere(const GrinderFiles& files, const GrinderInput& input) {
  if (!files.ground_blade || (*files.ground_blade >= 1 && *files.ground_blade <= input.blades.count)) return;
  throw std::invalid_argument("--ground-blade " + std::to_string(*files.ground_blade) + ": the blisk has " +
                              std::to_string(input.blades.count) + " blades, numbered from 1");
}

}  // namespace

void addGrinderOptions(CLI::App& command, GrinderFiles& files) {
  command.add_option("--blisk", files.blisk, "Mesh file (mm, axis Z); default: the built-in blisk")
      ->check(notEmpty());
  command
      .add_option(
          "--belt", files.belt,
          "Mesh file of a belt (mm, contact wheel at the origin, arm along +x), taken alone; default: "
          "the built-in grinder with belt, wheels and arm")
      ->check(notEmpty());
  command.add_option("-o,--out", files.out, "Folder for what is written; made where missing")
      ->required()
      ->check(notEmpty());
  command
      .add_option(
          "--ground-blade", files.ground_blade,
          "Number of the blade that the belt is to touch; default: 1, or with --path the blade touched "
          "most")
      ->check(wholeNumberFrom(1, kMostBladesOfBlisk));
  command
      .add_option("--max-depth", files.max_depth,
                  "mm that the belt may be pressed into the ground blade, as grind measures it")
      ->check(numberFrom(0.0, kMaxLength))
      ->capture_default_str();
  command
      .add_option("--margin", files.margin,
                  "mm that all must keep apart but the belt and the ground blade; 0: they must not touch")
      ->check(numberFrom(0.0, kMostMargin))
      ->capture_default_str();
  command
      .add_option("--threads", files.threads,
                  "Threads; 0: all that the machine has. The answers are the same")
      ->check(wholeNumberFrom(0, 1024))
      ->capture_default_str();
}

GrinderInput readGrinder(const GrinderFiles& files) {
  GrinderInput input;
  input.blisk_name = files.blisk.empty() ? "the blisk" : files.blisk;
  input.blisk = treeOf(files.blisk.empty() ? embeddedBlisk() : readFacingOutward(files.blisk));
  input.blades = findBlades(input.blisk->mesh());
  requireBladeThere(files, input);
  if (files.belt.empty()) {
    for (EmbeddedPart& part : embeddedBeltGrinder()) {
      input.parts.push_back({std::move(part.name), treeOf(std::move(part.mesh))});
    }
  } else {
    input.parts.push_back({"belt", treeOf(readFacingOutward(files.belt))});
  }
  return input;
}

std::vector<Pose> builtInPath(const GrinderInput& input, int blade) {
  if (input.blades.count == 0) {
    throw std::invalid_argument(
        input.blisk_name +
        ": no blades were found round the z axis, so no path can be made: give one by --path");
  }
  const BeltParameters belt;
  GrindingPathOptions options;
  options.blade = blade;
  options.wheel_radius = belt.contact_wheel_radius + belt.thickness;
  return makeGrindingPath(input.blisk->mesh(), input.blades, options);
}

int groundBladeOf(const GrinderFiles& files, const GrinderInput& input, const std::vector<Pose>& path) {
  if (files.ground_blade) return *files.ground_blade;
  if (files.path.empty()) return input.blades.count > 0 ? 1 : 0;
  return bladeTouchedMost(*input.blisk, *input.parts.front().tree, input.blades.blade_of_triangle, path,
                          files.threads);
}

void requireNotRead(const GrinderFiles& files, const std::vector<std::string>& tables) {
  for (const std::string& table : tables) {
    const std::filesystem::path file = std::filesystem::path(files.out) / table;
    for (const std::string& input : {files.path, files.blisk, files.belt}) {
      std::error_code ignored;  // mostly there is no such file
      if (!input.empty() && std::filesystem::equivalent(input, file, ignored)) {
        throw std::runtime_error(file.string() + ": cannot be both read and written");
      }
    }
  }
}

void makeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder + ": the folder cannot be made: " + error.message());
}

void warnOfInput(const GrinderInput& input) {
  const auto warn = [&](const std::string& what) {
    std::cerr << "octoblisk: warning: " << input.blisk_name << ": " << what << '\n';
  };
  if (input.blades.count == 0) {
    warn("no blades were found round the z axis: every touch counts as interference with hub or shroud");
  }
  const OpenEdges open = openEdges(input.blisk->mesh());
  if (open.count > 0) {
    warn(describe(open) +
         ", so it is no solid: depths are those of pairs of triangles, which shrink as meshes get finer, and "
         "a "
         "part wholly inside goes unnoticed");
  }
}

}  // namespace octoblisk::demos
