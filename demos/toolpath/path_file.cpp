#include "toolpath/path_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "io/input_file.h"
#include "toolpath/cl_moves.h"
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

/// The header of a table of poses, behind blank lines and comments.
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
  return true;  // an empty file: the table's complaint is the plainer one
}

}  // namespace

bool isClFile(const std::filesystem::path& file) {
  const std::string extension = extensionOf(file);
  if (extension == ".csv") return false;
  if (std::ranges::find(kClExtensions, extension) != kClExtensions.end()) return true;
  return !beginsAsTable(file);
}

PathFile readPathFile(const std::filesystem::path& file, const ClusteredOctree& blisk) {
  if (!isClFile(file)) return {readMoves(file), {}};
  ClFile read = readClFile(file);
  return {toolMovesOf(read, blisk), std::move(read.unknown)};
}

}  // namespace octoblisk::demos
