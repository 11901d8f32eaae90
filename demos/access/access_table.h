// The table of an accessibility map: a row for each point, as it is written and read back.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "access/access_map.h"

namespace octoblisk::demos {

/// What is asked at each point.
struct AccessQuestion {
  bool of_path = false;                  ///< the points are a path's poses
  VerdictRules rules{.near_miss = 0.0};  ///< as reachRulesOf (command_line/grinder_input.h) makes them
  AccessOptions options;

  std::size_t poses() const { return options.leads.size() * static_cast<std::size_t>(options.tilts); }
};

/// In one line, and back. Throws std::invalid_argument where the line is another.
std::string lineOf(const AccessQuestion& question);
AccessQuestion questionOfLine(const std::string& line);

/// The table's first line, without its end.
std::string accessColumns();

/// A point's row, with its end. Numbers have nine digits.
std::string rowOfSite(std::size_t index, const ContactSite& site, const SiteAccess& access,
                      const AccessQuestion& question, std::span<const ToolPart> parts,
                      const BodyNames& names);

/// What the picture and the table of ranges need of a row.
struct AccessRow {
  double arc = 0.0, height = 0.0;              ///< mm; arc NaN: not known
  double half_width = 0.0, half_height = 0.0;  ///< mm, of its cell; 0: it has none
  double widest = -1.0;             ///< degrees, of its widest free range; below 0: nothing is free
  std::vector<std::string> ranges;  ///< "lead,from,to" of each
};

/// Of a row's line, without its end. Throws std::invalid_argument where it is another.
AccessRow rowOfLine(std::string_view line);

/// Reads a table that was written so. Throws std::runtime_error naming file and line.
std::vector<AccessRow> readAccessTable(const std::filesystem::path& file);

/// ranges.csv: a row for each free range of tilt. Throws std::runtime_error naming a file that can't be
/// written.
void writeRanges(std::span<const AccessRow> rows, const std::filesystem::path& file);

}  // namespace octoblisk::demos
