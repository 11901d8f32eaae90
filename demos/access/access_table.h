// Writes and reads the table of an accessibility map, one row per point.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "access/access_map.h"

namespace octoblisk::demos {

/// The options that are the same for all points.
struct AccessQuestion {
  bool of_path = false;                  ///< the points are a path's poses
  VerdictRules rules{.near_miss = 0.0};  ///< as reachRulesOf (command_line/grinder_input.h) makes them
  AccessOptions options;

  std::size_t poses() const { return options.leads.size() * static_cast<std::size_t>(options.tilts); }
};

/// Converts to one line and back. Throws std::invalid_argument for any other line.
std::string lineOf(const AccessQuestion& question);
AccessQuestion questionOfLine(const std::string& line);

/// The table's header, without its line end.
std::string accessColumns();

/// A point's row, with its line end. Numbers have nine digits.
std::string rowOfSite(std::size_t index, const ContactSite& site, const SiteAccess& access,
                      const AccessQuestion& question, std::span<const ToolPart> parts,
                      const BodyNames& names);

/// The values of a row that the picture and the table of ranges need.
struct AccessRow {
  double arc = 0.0, height = 0.0;              ///< mm; arc NaN: unknown
  double half_width = 0.0, half_height = 0.0;  ///< mm, of its cell; 0: no cell
  double widest = -1.0;                        ///< degrees, of its widest free range; negative: no free range
  std::vector<std::string> ranges;             ///< "lead,from,to" per range
};

/// Reads a row without its line end. Throws std::invalid_argument for any other line.
AccessRow rowOfLine(std::string_view line);

/// Reads a table written by this project. Throws std::runtime_error naming file and line.
std::vector<AccessRow> readAccessTable(const std::filesystem::path& file);

/// ranges.csv: one row per free range of tilt. Throws std::runtime_error naming a file that cannot be
/// written.
void writeRanges(std::span<const AccessRow> rows, const std::filesystem::path& file);

}  // namespace octoblisk::demos
