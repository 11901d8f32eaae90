// What grind, access and repair read: the blisk with its blades, the tool and the path.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grinding/judge.h"
#include "grinding/run_watch.h"
#include "grinding/tool_assembly.h"
#include "models/blade_finder.h"
#include "octoblisk/build_options.h"
#include "study/ranks.h"
#include "toolpath/path_file.h"

namespace octoblisk::demos {

/// Options that the three have in common.
struct GrinderFiles {
  std::string blisk, belt, tool, path;  ///< files; empty: the defaults
  std::vector<std::string> obstacles;   ///< "mesh" or "mesh,name" of each
  std::string axis;                     ///< as axis_option.h reads it; empty: to be found
  std::string units;                    ///< of blisk and obstacles, as units_option.h reads it; empty: mm
  std::string tool_units;               ///< of the meshes of belt or tool, likewise
  std::string out;                      ///< a folder
  std::optional<int> ground_blade;
  double max_depth = 0.1;  ///< mm
  int threads = 0;
  BuildOptions tree;  ///< of the trees' partition; parts are filled in

  std::string bliskName() const { return blisk.empty() ? "the blisk" : blisk; }
  std::string toolName() const { return !tool.empty() ? tool : belt.empty() ? "default" : belt; }
};

/// A user's mesh in mm, facing outward: readOutward (models/outward_mesh.h), with its notes as warnings on
/// standard error, then inMillimetres (units_option.h).
TriangleMesh readUsersMesh(const std::filesystem::path& file, const std::string& units);

/// Adds them but for --path, whose default differs.
void addGrinderOptions(CLI::App& command, GrinderFiles& files);

/// Adds --margin (mm) of access and repair.
void addMarginOption(CLI::App& command, double& margin);

struct GrinderInput {
  std::shared_ptr<const ClusteredOctree> blisk;  ///< as in its file, but facing outward
  Pose mesh_in_blisk;                            ///< from the file's frame to that with the axis Z
  BladesFound blades;                            ///< none: count 0
  ToolAssembly tool;
  std::vector<Fixture> fixtures;
  double tree_seconds = 0.0;  ///< to build the blisk's tree

  BodyNames names() const { return BodyNames(blades.count, fixtures); }
};

/// Reads blisk and tool; tells where triangles face inward, and are turned. The blades are those of findBlisk
/// (models/blisk_axis.h) or, where it proves none, of findBlades round the Z axis; about --axis if it is
/// given. Throws naming the file, or the blade that there is not, and if --units is not given and the sizes
/// of blisk and tool do not fit (units_option.h).
GrinderInput readGrinder(const GrinderFiles& files);

/// The same at all of several ranks, with the blisk's tree built once a node (study/node_inputs.h).
GrinderInput readGrinder(const GrinderFiles& files, Ranks& ranks);

/// The built-in path over a blade's side, in the file's frame. Throws naming the blisk where it has no
/// blades.
std::vector<Pose> builtInPath(const GrinderFiles& files, const GrinderInput& input);

/// The user's file, a table or a CL file; warns of words of it that are passed over.
PathFile readPath(const std::string& file, const ClusteredOctree& blisk);

/// The blade asked for; else of a path of one's own the blade that the grinding part touches at the most of
/// its poses, 0 where it touches none, nothing where the watch stopped it; else 1.
std::optional<int> groundBladeOf(const GrinderFiles& files, const GrinderInput& input,
                                 const std::vector<Pose>& path, const RunWatch& watch = {});

/// What access and repair judge by: the margin (mm) is the near_miss of every pair. They know of one part
/// that may touch one blade: throws naming the tool's file where its table allows more, or nothing.
VerdictRules reachRulesOf(const GrinderFiles& files, const GrinderInput& input, int ground_blade,
                          double margin);

/// Throws naming one of the tables in the folder if it is a file that is read.
void requireNotRead(const GrinderFiles& files, const std::vector<std::string>& tables);

/// On standard error, a line.
void warnOf(const std::string& of, const std::string& what);

/// Throws std::invalid_argument naming the option if a margin (mm) is more than a fiftieth of the blisk's
/// size: nearly all triangles would then be near at every pose.
void requireMarginFits(const GrinderInput& input, const std::string& option, double margin);

/// Warns of what is judged otherwise than one may think: an open blisk, no blades.
void warnOfInput(const GrinderFiles& files, const GrinderInput& input);

}  // namespace octoblisk::demos
