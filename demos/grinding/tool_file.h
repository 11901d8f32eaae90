// A tool's parts, and what may touch what, in a JSON file that people edit.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grinding/pair_rules.h"

namespace octoblisk::demos {

/// The greatest near-miss distance: the pairs of triangles within it grow with its square. mm.
inline constexpr double kMostNearMiss = 5.0;

/// The greatest speed of a belt, m/s.
inline constexpr double kMostBeltSpeed = 1000.0;

struct ToolFilePart {
  std::string name;
  std::filesystem::path mesh;             ///< as it can be opened
  std::optional<double> max_depth;        ///< that it may be pressed into what it may touch, mm
  std::optional<double> belt_speed = {};  ///< of a belt: below 0 the other way round (belt_loop.h), m/s
};

/// What a tool file says:
///
///     {
///       "parts": [{"name": "belt", "mesh": "belt.ply", "max_depth_mm": 0.1, "belt_speed_m_s": 30},
///                 {"name": "arm", "mesh": "arm.ply"}],
///       "allowed": [{"part": "belt", "blade": "ground"}],
///       "margins": [{"part": "arm", "blade": "any", "near_miss_mm": 2}]
///     }
///
/// A mesh is in the tool's frame, mm; its path is relative to the tool file. "part" may be "any"; "blade" is
/// a number from 1, "ground" (the blade that is ground), "hub" (hub and shroud) or "any" (all of these). What
/// is in no row of "allowed" must not touch. Of several rows of "margins" for a pair the last counts.
/// "max_depth_mm", "belt_speed_m_s", "allowed" and "margins" may be left out.
struct ToolFile {
  std::vector<ToolFilePart> parts;
  std::vector<AllowedPair> allowed;
  std::vector<PairMargin> margins;
};

/// Throws std::runtime_error in one line that names the file, and the line or the key: no such file, no JSON,
/// an unknown or repeated key, one that is missing or of a wrong type, a number out of its range, no parts or
/// two of one name, a part that there is not, a mesh file that there is not.
ToolFile readToolFile(const std::filesystem::path& file);

/// Writes what readToolFile reads; meshes by their paths as they are given.
/// Throws std::runtime_error naming a file that cannot be written.
void writeToolFile(const std::filesystem::path& file, const ToolFile& tool);

}  // namespace octoblisk::demos
