#include "toolpath/path_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "io/input_file.h"
#include "io/new_file.h"
#include "toolpath/cl_motions.h"
#include "toolpath/machine_program.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

constexpr std::array<std::string_view, 6> kClExtensions = {".apt", ".cl",  ".cls",
                                                           ".clf", ".ncl", ".aptsource"};

std::string extensionOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& letter : extension) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return extension;
}

/// True if a table of poses begins here: its header may follow blank lines and comments.
bool beginsAsTable(const std::filesystem::path& file) {
  std::ifstream stream = openForReading(file);
  std::string line;
  while (std::getline(stream, line)) {
    std::erase_if(line, [](char letter) { return std::isspace(static_cast<unsigned char>(letter)) != 0; });
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    if (line.empty() || line.front() == '#') continue;
    return line.starts_with("x,");
  }
  return true;  // an empty file: reading it as a table gives the clearer message
}

/// Without line ends, except for carriage returns.
std::vector<std::string> linesOf(const std::filesystem::path& file) {
  std::ifstream stream = openForReading(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

constexpr double kSamePose = 1e-9;  // mm; also for a rotation's entries

bool isSame(const Pose& a, const Pose& b, double within) {
  return (a.rotation - b.rotation).cwiseAbs().maxCoeff() <= within &&
         (a.translation - b.translation).cwiseAbs().maxCoeff() <= within;
}

/// "FROM" or "GOTO": the word of the changed statement.
const char* wordOf(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string::npos && std::toupper(static_cast<unsigned char>(line[first])) == 'F' ? "FROM"
                                                                                                    : "GOTO";
}

std::string withoutReturn(std::string text) {
  if (text.ends_with('\r')) text.pop_back();
  return text;
}

/// The comment " $$ ..." after a statement, if any.
std::string commentOf(const std::string& line) {
  const std::size_t dollars = line.find("$$");
  return dollars == std::string::npos ? std::string() : ' ' + withoutReturn(line.substr(dollars));
}

/// The rest of a table's row: ",feed", if any.
std::string behindPose(const std::string& row) {
  std::size_t comma = row.find(',');
  for (int i = 1; i < 7 && comma != std::string::npos; ++i) comma = row.find(',', comma + 1);
  return comma == std::string::npos ? std::string() : withoutReturn(row.substr(comma));
}

}  // namespace

std::vector<Pose> PathFile::poses() const {
  std::vector<Pose> found;
  for (const ToolMotion& motion : motions) found.push_back(motion.tool_in_blisk);
  return found;
}

bool isClFile(const std::filesystem::path& file) {
  const std::string extension = extensionOf(file);
  if (extension == ".csv") return false;
  if (std::ranges::find(kClExtensions, extension) != kClExtensions.end()) return true;
  return !beginsAsTable(file);
}

PathFile readPathFile(const std::filesystem::path& file, const ClusteredOctree& blisk) {
  if (const auto program = machineProgramIn(file)) {
    throw std::runtime_error(
        file.string() + ": seems to be " + std::string(*program) +
        ", not a toolpath: export the path from the CAM system as a CL file (APT), or as a "
        "table of poses (octoblisk path writes examples)");
  }
  PathFile path;
  if (!isClFile(file)) {
    for (const auto& [motion, line] : readMotionRows(file)) {
      path.motions.push_back(motion);
      path.lines.push_back({line, line});
    }
    return path;
  }
  ClFile read = readClFile(file);
  path.motions = toolMotionsOf(read, blisk);
  for (const ClMotion& motion : read.motions)
    path.lines.push_back({motion.line, motion.last_line, motion.unit});
  path.unknown = std::move(read.unknown);
  path.second_tool = read.second_tool;
  return path;
}

void writeChangedPath(const PathFile& read, const std::filesystem::path& source, const ClusteredOctree& blisk,
                      std::span<const Pose> poses, const std::filesystem::path& target) {
  const bool is_cl = isClFile(source);
  const std::vector<std::string> lines = linesOf(source);
  std::vector<bool> is_changed;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    is_changed.push_back(!isSame(poses[i], read.motions[i].tool_in_blisk, 0.0));
  }
  for (bool is_settled = false; !is_settled;) {
    std::ostringstream stream;
    stream.precision(std::numeric_limits<double>::max_digits10);
    std::size_t next = 0;  // line
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!is_changed[i]) continue;
      const auto& [first, last, unit] = read.lines[i];
      for (; next < first - 1; ++next) stream << lines[next] << '\n';
      const std::string& text = lines[last - 1];
      if (is_cl) {
        writeGoto(stream, wordOf(lines[first - 1]), poses[i], unit);
        stream << commentOf(text);
      } else {
        writePose(stream, poses[i]);
        stream << behindPose(text);
      }
      stream << (text.ends_with('\r') ? "\r\n" : "\n");
      next = last;
    }
    for (; next < lines.size(); ++next) stream << lines[next] << '\n';
    writeFile(target, stream.str());
    is_settled = true;
    if (!is_cl) continue;
    const std::vector<ToolMotion> again = toolMotionsOf(readClFile(target), blisk);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (is_changed[i] || isSame(poses[i], again[i].tool_in_blisk, kSamePose)) continue;
      is_changed[i] = true;  // it depends on a changed motion
      is_settled = false;
    }
  }
}

}  // namespace octoblisk::demos
