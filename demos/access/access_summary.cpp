#include "access/access_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "io/quoted_text.h"

namespace octoblisk::demos {

std::string describe(const Obstruction& obstacle, std::span<const ToolPart> parts, const BodyNames& names) {
  const std::string& part = parts[obstacle.part].name;
  const std::string body = names.nameOf(obstacle.blade);
  if (obstacle.is_inside) return part + " wholly inside";
  if (obstacle.too_deep) return part + " too deep in " + body;
  return part + " on " + body;
}

void AccessSummary::count(const SiteAccess& access, std::span<const ToolPart> parts, const BodyNames& names) {
  ++points;
  free_poses += access.free;
  if (access.free > 0) return;
  ++nowhere_free;
  ++obstacles[describe(access.obstacles.front().obstacle, parts, names)];
}

void AccessSummary::add(const AccessSummary& other) {
  points += other.points;
  free_poses += other.free_poses;
  nowhere_free += other.nowhere_free;
  for (const auto& [what, times] : other.obstacles) obstacles[what] += times;
}

std::string tallyOf(const AccessSummary& summary) {
  std::string line = std::to_string(summary.points) + ' ' + std::to_string(summary.free_poses) + ' ' +
                     std::to_string(summary.nowhere_free);
  // Names of parts have no tabs.
  for (const auto& [what, times] : summary.obstacles) line += '\t' + std::to_string(times) + ' ' + what;
  return line;
}

AccessSummary accessSummaryOfTally(const std::string& tally) {
  AccessSummary summary;
  std::istringstream stream(tally);
  std::string first;
  std::getline(stream, first, '\t');
  std::istringstream numbers(first);
  numbers >> summary.points >> summary.free_poses >> summary.nowhere_free;
  for (std::string entry; std::getline(stream, entry, '\t');) {
    std::istringstream words(entry);
    std::size_t times = 0;
    std::string what;
    words >> times;
    words.ignore();
    std::getline(words, what);
    summary.obstacles[what] += times;
  }
  const bool is_printable = std::ranges::all_of(
      tally, [](char letter) { return letter == '\t' || (letter >= ' ' && letter <= '~'); });
  // The line must match exactly, so a line that is only partly understood is refused.
  if (!is_printable || tallyOf(summary) != tally)
    throw std::invalid_argument("has a tally that is not from an accessibility map: " + inQuotes(tally));
  return summary;
}

std::string summaryText(const AccessSummary& summary, const AccessQuestion& question) {
  const auto numberOf = [](std::size_t count, const std::string& one) {
    return std::to_string(count) + ' ' + one + (count == 1 ? "" : "s");
  };
  const auto asked = static_cast<double>(std::max<std::size_t>(1, summary.points * question.poses()));
  std::ostringstream text;
  text << numberOf(summary.points, "point") << " of blade " << question.rules.ground_blade << ", "
       << numberOf(static_cast<std::size_t>(question.options.tilts), "tilt") << " at "
       << numberOf(question.options.leads.size(), "lead")
       << " each: " << std::round(1000.0 * static_cast<double>(summary.free_poses) / asked) / 10.0
       << " % free; " << summary.nowhere_free << " without a free pose\n";
  for (const auto& [what, times] : summary.obstacles) {
    text << "  most frequent obstacle there: " << what << ", at " << numberOf(times, "point") << '\n';
  }
  return text.str();
}

std::string reachText(std::span<const AccessRow> rows) {
  double all = 0.0, free = 0.0;
  double lowest_free = std::numeric_limits<double>::infinity(), highest_free = -lowest_free;
  double highest_below = -lowest_free, lowest_above = lowest_free;
  const bool has_areas =
      std::ranges::all_of(rows, [](const AccessRow& row) { return row.half_width * row.half_height > 0.0; });
  for (const AccessRow& row : rows) {
    const double area = has_areas ? row.half_width * row.half_height : 1.0;
    all += area;
    if (row.widest < 0.0) continue;
    free += area;
    lowest_free = std::min(lowest_free, row.height);
    highest_free = std::max(highest_free, row.height);
  }
  for (const AccessRow& row : rows) {
    if (row.height < lowest_free) highest_below = std::max(highest_below, row.height);
    if (row.height > highest_free) lowest_above = std::min(lowest_above, row.height);
  }
  std::ostringstream text;
  text.precision(3);
  text << "Can be ground: " << std::round(100.0 * free / std::max(all, 1e-300)) << " % of the "
       << (has_areas ? "area around the points" : "points");
  if (free == 0.0) return text.str();
  if (std::isfinite(highest_below)) text << "; none up to " << highest_below << " mm above the root";
  if (std::isfinite(lowest_above)) text << "; none from " << lowest_above << " mm above the root";
  return text.str();
}

}  // namespace octoblisk::demos
