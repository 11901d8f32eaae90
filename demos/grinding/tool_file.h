// Reads and writes JSON tool files: a tool's parts, and rules of what may touch what. People edit these
// files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grinding/pair_rules.h"

namespace octoblisk::demos {

/// The greatest near-miss distance, mm: the number of triangle pairs within it grows with its square.
inline constexpr double kMaxNearMiss = 5.0;

/// The greatest speed of a belt, m/s.
inline constexpr double kMaxBeltSpeed = 1000.0;

struct ToolFilePart {
  std::string name;
  std::filesystem::path mesh;             ///< as a path that can be opened
  std::optional<double> max_depth;        ///< greatest depth in a blade that the part may touch, mm
  std::optional<double> belt_speed = {};  ///< of a belt, m/s; negative in the other direction (belt_loop.h)
};

/// The content of a tool file:
///
///     {
///       "parts": [{"name": "belt", "mesh": "belt.ply", "max_depth_mm": 0.1, "belt_speed_m_s": 30},
///                 {"name": "arm", "mesh": "arm.ply"}],
///       "allowed": [{"part": "belt", "blade": "ground"}],
///       "margins": [{"part": "arm", "blade": "any", "near_miss_mm": 2}]
///     }
///
/// A mesh is in the tool's frame, mm; its path is relative to the tool file. "part" may be "any"; "blade" is
/// a number from 1, "ground" (the ground blade), "hub" (hub and shroud) or "any" (all of these). Pairs
/// without a row in "allowed" must not touch. If several rows of "margins" match a pair, the last one counts.
/// "max_depth_mm", "belt_speed_m_s", "allowed" and "margins" are optional.
struct ToolFile {
  std::vector<ToolFilePart> parts;
  std::vector<AllowedPair> allowed;
  std::vector<PairMargin> margins;
};

/// Throws std::runtime_error with a one-line message that names the file, and the line or key: for a file
/// that does not exist or is not JSON; a key that is unknown, repeated, missing or of the wrong type; a
/// number out of range; no parts, two parts with one name, or a reference to a missing part; a mesh file that
/// does not exist.
ToolFile readToolFile(const std::filesystem::path& file);

/// Writes a file for readToolFile; mesh paths stay as they are given.
/// Throws std::runtime_error naming a file that cannot be written.
void writeToolFile(const std::filesystem::path& file, const ToolFile& tool);

}  // namespace octoblisk::demos
