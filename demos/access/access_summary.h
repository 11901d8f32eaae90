// What is told of an accessibility map in words.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "access/access_table.h"

namespace octoblisk::demos {

/// "belt on blade 2", "arm on hub or shroud", "belt too deep in blade 1", "arm wholly inside".
std::string describe(const Hindrance& obstacle, std::span<const ToolPart> parts, const BodyNames& names);

/// What a summary counts.
struct AccessSummary {
  std::size_t points = 0;
  std::size_t free_poses = 0;    ///< of all tilts and leads of all points
  std::size_t nowhere_free = 0;  ///< points
  /// Of these, what is in the way the most often, and of how many.
  std::map<std::string, std::size_t> in_the_way;

  void count(const SiteAccess& access, std::span<const ToolPart> parts, const BodyNames& names);
  void add(const AccessSummary& other);
};

/// One line, and back. Throws std::invalid_argument where the line is another.
std::string tallyOf(const AccessSummary& summary);
AccessSummary accessSummaryOfTally(const std::string& tally);

/// Lines with their ends.
std::string inWords(const AccessSummary& summary, const AccessQuestion& question);

/// "Can be ground: 67 % of the area round the points; of those up to 12.5 mm above the root, none". The
/// points of a path, which have no area, count alike.
std::string reachInWords(std::span<const AccessRow> rows);

}  // namespace octoblisk::demos
