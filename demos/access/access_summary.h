// Summarises an accessibility map in words.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "access/access_table.h"

namespace octoblisk::demos {

/// "belt on blade 2", "arm on hub or shroud", "belt too deep in blade 1", "arm wholly inside".
std::string describe(const Obstruction& obstacle, std::span<const ToolPart> parts, const BodyNames& names);

/// Counts over the points of a map.
struct AccessSummary {
  std::size_t points = 0;
  std::size_t free_poses = 0;    ///< over all tilts and leads of all points
  std::size_t nowhere_free = 0;  ///< points without a free pose
  /// For these points, the most frequent obstacle, and how many points have it.
  std::map<std::string, std::size_t> obstacles;

  void count(const SiteAccess& access, std::span<const ToolPart> parts, const BodyNames& names);
  void add(const AccessSummary& other);
};

/// Converts to one line and back. Throws std::invalid_argument for any other line.
std::string tallyOf(const AccessSummary& summary);
AccessSummary accessSummaryOfTally(const std::string& tally);

/// Lines with line ends.
std::string summaryText(const AccessSummary& summary, const AccessQuestion& question);

/// "Can be ground: 67 % of the area around the points; none up to 12.5 mm above the root". The points of a
/// path have no area, so each counts once.
std::string reachText(std::span<const AccessRow> rows);

}  // namespace octoblisk::demos
