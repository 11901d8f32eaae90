#include "access/access_table.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "io/csv_table.h"
#include "io/input_file.h"
#include "io/new_file.h"
#include "io/number_text.h"
#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

constexpr const char* kAccessColumns =
    "point,pose,x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,height_mm,arc_mm,free_fraction,"
    "lead_deg,tilt_from_deg,tilt_to_deg,lead_from_deg,lead_to_deg,part,blade,"
    "half_width_mm,half_height_mm,free_ranges";

/// The columns that are read back.
enum AccessColumn {
  kHeightColumn = 8,
  kArcColumn = 9,
  kTiltFromColumn = 12,
  kTiltToColumn = 13,
  kHalfWidthColumn = 18,
  kHalfHeightColumn = 19,
  kRangesColumn = 20  // the last
};

std::vector<std::string> cellsOf(std::string_view line, char delimiter) {
  std::vector<std::string> cells;
  for (;;) {
    const std::size_t end = line.find(delimiter);
    cells.emplace_back(line.substr(0, end));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

/// NaN for an empty cell.
double valueOf(const std::string& cell) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || stop != cell.data() + cell.size()) throw std::invalid_argument(cell);
  return value;
}

AccessRow rowOfCells(const std::vector<std::string>& cells) {
  if (cells.size() != kRangesColumn + 1) throw std::invalid_argument("columns");
  AccessRow row;
  row.height = valueOf(cells[kHeightColumn]);
  row.arc = valueOf(cells[kArcColumn]);
  row.half_width = valueOf(cells[kHalfWidthColumn]);
  row.half_height = valueOf(cells[kHalfHeightColumn]);
  if (!cells[kTiltFromColumn].empty())
    row.widest = valueOf(cells[kTiltToColumn]) - valueOf(cells[kTiltFromColumn]);
  if (cells[kRangesColumn].empty()) return row;
  for (const std::string& range : cellsOf(cells[kRangesColumn], ';')) {
    std::string comma_separated = range;
    for (char& letter : comma_separated) letter = letter == ' ' ? ',' : letter;
    row.ranges.push_back(comma_separated);
  }
  return row;
}

}  // namespace

std::string lineOf(const AccessQuestion& question) {
  const auto& [of_path, rules, options] = question;
  std::string line = std::string(of_path ? "path" : "grid") + " part " + std::to_string(rules.grinding_part) +
                     " blade " + std::to_string(rules.ground_blade) + " depth " + exactText(rules.max_depth) +
                     " margin " + exactText(rules.near_miss) + " tilts " + std::to_string(options.tilts) +
                     ' ' + exactText(options.tilt_from) + ' ' + exactText(options.tilt_step) + " leads";
  for (const double lead : options.leads) line += ' ' + exactText(lead);
  return line;
}

AccessQuestion questionOfLine(const std::string& line) {
  AccessQuestion question;
  auto& [of_path, rules, options] = question;
  std::istringstream words(line);
  std::string kind, part, blade, depth, margin, tilts, leads;
  words >> kind >> part >> rules.grinding_part >> blade >> rules.ground_blade >> depth >> rules.max_depth >>
      margin >> rules.near_miss >> tilts >> options.tilts >> options.tilt_from >> options.tilt_step >> leads;
  of_path = kind == "path";
  options.leads.clear();
  for (double lead = 0.0; words >> lead;) options.leads.push_back(lead);
  // The line must match exactly, so a line that is only partly understood is refused.
  if (lineOf(question) != line) {
    throw std::invalid_argument("has options that are not from an accessibility map: " + inQuotes(line));
  }
  return question;
}

std::string accessColumns() { return kAccessColumns; }

std::string rowOfSite(std::size_t index, const ContactSite& site, const SiteAccess& access,
                      const AccessQuestion& question, std::span<const ToolPart> parts,
                      const BodyNames& names) {
  std::ostringstream stream;
  stream.precision(9);
  stream << index << ',';
  if (question.of_path) stream << site.pose;
  for (const Vec3& v : {site.point, site.normal}) stream << ',' << v.x() << ',' << v.y() << ',' << v.z();
  stream << ',' << site.height << ',';
  if (std::isfinite(site.arc)) stream << site.arc;
  stream << ',' << static_cast<double>(access.free) / static_cast<double>(question.poses());
  const std::vector<double>& leads = question.options.leads;
  if (access.widest) {
    const FreeRange& widest = access.ranges[*access.widest];
    stream << ',' << leads[widest.lead] << ',' << widest.tilt_from << ',' << widest.tilt_to << ','
           << access.lead_from << ',' << access.lead_to;
  } else {
    stream << ",,,,,";
  }
  if (access.obstacles.empty()) {
    stream << ",,";
  } else {
    const Obstruction& most = access.obstacles.front().obstacle;
    stream << ',' << parts[most.part].name << ',' << names.cellOf(most.blade);
  }
  stream << ',' << site.half_width << ',' << site.half_height << ',';
  const char* between = "";
  for (const FreeRange& range : access.ranges) {
    stream << between << leads[range.lead] << ' ' << range.tilt_from << ' ' << range.tilt_to;
    between = ";";
  }
  stream << '\n';
  return stream.str();
}

AccessRow rowOfLine(std::string_view line) {
  try {
    return rowOfCells(cellsOf(line, ','));
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument("has a row that is not from an accessibility map: " + inQuotes(line));
  }
}

std::vector<AccessRow> readAccessTable(const std::filesystem::path& file) {
  std::ifstream stream = openForReading(file);
  std::string line;
  std::size_t number = 1;
  if (!std::getline(stream, line) || line != kAccessColumns) {
    throw std::runtime_error(atLine(
        file, number, "this is not the header of an accessibility map; give points.csv of octoblisk access"));
  }
  std::vector<AccessRow> rows;
  while (std::getline(stream, line)) {
    ++number;
    try {
      rows.push_back(rowOfLine(line));
    } catch (const std::invalid_argument&) {
      throw std::runtime_error(atLine(file, number, "this is not a row of an accessibility map"));
    }
  }
  return rows;
}

void writeRanges(std::span<const AccessRow> rows, const std::filesystem::path& file) {
  std::ostringstream stream;
  stream << "point,lead_deg,tilt_from_deg,tilt_to_deg\n";
  for (std::size_t point = 0; point < rows.size(); ++point) {
    for (const std::string& range : rows[point].ranges) stream << point << ',' << range << '\n';
  }
  writeFile(file, stream.str());
}

}  // namespace octoblisk::demos
