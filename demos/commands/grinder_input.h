// What access and repair read: the blisk, the tool and the path, as octoblisk grind takes them.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell/grinding_cell.h"
#include "models/blade_finder.h"

namespace octoblisk::demos {

/// Options that the two have in common.
struct GrinderFiles {
  std::string blisk, belt, path;  ///< files; empty: the defaults
  std::string out;                ///< a folder
  std::optional<int> ground_blade;
  double max_depth = 0.1;  ///< mm
  double margin = 0.0;     ///< mm
  int threads = 0;
};

/// Adds them but for --path, whose default differs.
void addGrinderOptions(CLI::App& command, GrinderFiles& files);

struct GrinderInput {
  std::string blisk_name;
  std::shared_ptr<const ClusteredOctree> blisk;
  BladesFound blades;
  std::vector<ToolPart> parts;
};

/// Reads blisk and tool; tells where triangles face inward, and are turned. Throws naming the file, or the
/// blade that there is not.
GrinderInput readGrinder(const GrinderFiles& files);

/// The built-in path over a blade's side. Throws naming the blisk where it has no blades.
std::vector<Pose> builtInPath(const GrinderInput& input, int blade);

/// The blade asked for; else of a path of one's own the blade that the belt touches at the most of its poses,
/// 0 where it touches none; else 1.
int groundBladeOf(const GrinderFiles& files, const GrinderInput& input, const std::vector<Pose>& path);

/// Throws naming one of the tables in the folder if it is the path that is read.
void requireNotRead(const GrinderFiles& files, const std::vector<std::string>& tables);

/// Makes the folder where it is missing. Throws naming it.
void makeFolder(const std::string& folder);

/// Warns of what is judged otherwise than one may think: an open blisk, no blades.
void warnOfInput(const GrinderInput& input);

}  // namespace octoblisk::demos
