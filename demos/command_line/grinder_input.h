// The input of grind, access and repair: the blisk with its blades, the tool and the path.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grinding/grinding_run.h"
#include "grinding/judge.h"
#include "grinding/run_watch.h"
#include "grinding/tool_assembly.h"
#include "models/blade_finder.h"
#include "octoblisk/build_options.h"
#include "study/ranks.h"
#include "toolpath/path_file.h"

namespace octoblisk::demos {

/// The options that the three subcommands share.
struct GrinderFiles {
  std::string blisk, belt, tool, path;  ///< files; empty: the defaults
  std::vector<std::string> obstacles;   ///< "mesh" or "mesh,name" of each
  std::string axis;                     ///< as blisk_options.h reads it; empty: found from the mesh
  std::string units;                    ///< of blisk and obstacles, as units_option.h reads it; empty: mm
  std::string tool_units;               ///< of the meshes of belt or tool
  std::string out;                      ///< a folder
  std::optional<int> ground_blade;
  double max_depth = 0.1;  ///< mm
  int threads = 0;
  BuildOptions tree;  ///< of the trees' partition; parts are filled in

  std::string bliskName() const { return blisk.empty() ? "the blisk" : blisk; }
  std::string toolName() const { return !tool.empty() ? tool : belt.empty() ? "default" : belt; }
};

/// A user's mesh in mm, facing outward. Notes of readOutward (models/outward_mesh.h) become warnings on
/// standard error; inMillimetres (units_option.h) converts the unit.
TriangleMesh readUsersMesh(const std::filesystem::path& file, const std::string& units);

/// Adds all of them except --path, whose default differs between the subcommands.
void addGrinderOptions(CLI::App& command, GrinderFiles& files);

/// Adds --margin (mm) for access and repair.
void addMarginOption(CLI::App& command, double& margin);

struct GrinderInput {
  std::shared_ptr<const ClusteredOctree> blisk;  ///< in its file's frame, facing outward
  Pose mesh_in_blisk;                            ///< from the file's frame to the frame whose Z is the axis
  BladesFound blades;                            ///< count 0 if none were found
  ToolAssembly tool;
  std::vector<Fixture> fixtures;
  double tree_seconds = 0.0;  ///< time to build the blisk's tree

  BodyNames names() const { return BodyNames(blades.count, fixtures); }
};

/// Reads blisk and tool, and warns about triangles that faced inward and are now reversed. The blades are
/// those of findBlisk (models/blisk_axis.h), about --axis if it is given; if findBlisk proves none, those of
/// findBlades about the Z axis. Throws naming the file, or the blade that does not exist; also if --units is
/// not given and the sizes of blisk and tool do not fit (units_option.h).
GrinderInput readGrinder(const GrinderFiles& files);

/// The same on several ranks, with the blisk's tree built once per node (study/node_inputs.h).
GrinderInput readGrinder(const GrinderFiles& files, Ranks& ranks);

/// The job for these files, without its path and ground blade.
GrindingJob jobWithoutPath(const GrinderFiles& files, const GrinderInput& input);

/// The built-in path over a blade's side, in the file's frame. Throws naming the blisk if it has no blades.
std::vector<Pose> builtInPath(const GrinderFiles& files, const GrinderInput& input);

/// The user's file, a table or a CL file. Warns about words in it that are ignored.
PathFile readPath(const std::string& file, const ClusteredOctree& blisk);

/// The blade that was asked for. Otherwise, for a user's path, the blade that the grinding part touches at
/// most poses: 0 if it touches none, nothing if the watch stopped the search. Otherwise 1.
std::optional<int> groundBladeOf(const GrinderFiles& files, const GrinderInput& input,
                                 const std::vector<Pose>& path, const RunWatch& watch = {});

/// The rules of access and repair: the margin (mm) is the near_miss of every pair. Only one part may touch,
/// and only one blade: throws naming the tool's file if its table allows more, or nothing.
VerdictRules reachRulesOf(const GrinderFiles& files, const GrinderInput& input, int ground_blade,
                          double margin);

/// Throws naming one of the output tables if that file is also an input.
void requireNotRead(const GrinderFiles& files, const std::vector<std::string>& tables);

/// Throws std::invalid_argument naming the option if a margin (mm) is more than a fiftieth of the blisk's
/// size: nearly all triangles would then be near at every pose.
void requireMarginFits(const GrinderInput& input, const std::string& option, double margin);

/// Warns if the blade to be ground was looked for in the user's path, and the path touches none (blade 0):
/// the path may have another unit or frame than the blisk.
void warnOfUntouched(const GrinderFiles& files, const GrinderInput& input, int ground_blade);

/// Warns about an open or defective blisk, and about a blisk without blades.
void warnOfInput(const GrinderFiles& files, const GrinderInput& input);

}  // namespace octoblisk::demos
