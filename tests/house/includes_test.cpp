// Includes point down the map of CONTRIBUTING.md. Its table lists the rooms from the bottom to the top and
// what each may include.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace octoblisk::house {
namespace {

const std::filesystem::path kProject = OCTOBLISK_SOURCE_DIR;

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(kProject / file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// All matches of the expression's first group.
std::vector<std::string> found(const std::string& text, const std::string& expression) {
  const std::regex regex(expression);
  std::vector<std::string> matches;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    matches.push_back((*match)[1]);
  return matches;
}

bool isBelow(const std::string& path, const std::string& folder) {
  return path == folder || path.starts_with(folder + '/');
}

/// A row of the map.
struct Room {
  std::string folder;
  std::vector<std::string> may_include;
};

/// The rows of the map. "above" in a row stands for all rows above it with the same first folder.
std::vector<Room> roomsOfTheMap() {
  std::vector<Room> rooms;
  std::istringstream lines(contentOf("CONTRIBUTING.md"));
  static const std::regex row(R"(\| `([a-z_/]+)` \|[^|]*\|([^|]*)\|)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    Room room{match[1], found(match[2], "`([a-z_/]+)`")};
    if (match[2].str().find("above") != std::string::npos) {
      const std::string first = room.folder.substr(0, room.folder.find('/'));
      for (const Room& above : rooms) {
        if (isBelow(above.folder, first)) room.may_include.push_back(above.folder);
      }
    }
    rooms.push_back(std::move(room));
  }
  return rooms;
}

std::vector<std::string> sourceFiles() {
  std::vector<std::string> files;
  for (const char* top : {"core", "plugin", "demos", "bench", "tests"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kProject / top)) {
      const std::string path = std::filesystem::relative(entry.path(), kProject).generic_string();
      if (path.find("node_modules") != std::string::npos) continue;
      if (path.ends_with(".h") || path.ends_with(".cpp")) files.push_back(path);
    }
  }
  std::ranges::sort(files);
  return files;
}

/// The innermost room that the file is in.
const Room* roomOf(const std::vector<Room>& rooms, const std::string& file) {
  const Room* innermost = nullptr;
  for (const Room& room : rooms) {
    if (isBelow(file, room.folder) && (!innermost || room.folder.size() > innermost->folder.size()))
      innermost = &room;
  }
  return innermost;
}

/// The files of the repository that each file includes.
using Includes = std::map<std::string, std::vector<std::string>>;

Includes includesOf(const std::vector<std::string>& files) {
  const std::set<std::string> known(files.begin(), files.end());
  Includes includes;
  for (const std::string& file : files) {
    std::vector<std::string> folders = {"core/include", "core/src", "plugin/include", "plugin/src",
                                        "demos",        "bench",    "tests"};
    // The folders of tests and benchmarks come first for their own files: both have a `report`.
    folders.insert(folders.begin(), file.substr(0, file.find('/')));
    folders.insert(folders.begin(), std::filesystem::path(file).parent_path().generic_string());
    for (const std::string& name : found(contentOf(file), R"(#include ["<]([a-z_0-9/.-]+\.h)[">])")) {
      const auto folder = std::ranges::find_if(
          folders, [&](const std::string& at) { return known.contains(at + '/' + name); });
      if (folder != folders.end()) includes[file].push_back(*folder + '/' + name);
    }
  }
  return includes;
}

TEST(Includes, pointDownTheMap) {
  const std::vector<Room> rooms = roomsOfTheMap();
  ASSERT_GT(rooms.size(), 20u);
  const std::vector<std::string> files = sourceFiles();
  ASSERT_GT(files.size(), 500u);
  std::size_t between_rooms = 0;
  for (const auto& [file, included] : includesOf(files)) {
    const Room* room = roomOf(rooms, file);
    ASSERT_TRUE(room) << file << " is in no room of CONTRIBUTING.md";
    for (const std::string& header : included) {
      const Room* other = roomOf(rooms, header);
      ASSERT_TRUE(other) << header << " is in no room of CONTRIBUTING.md";
      if (room == other) continue;
      ++between_rooms;
      EXPECT_TRUE(std::ranges::any_of(room->may_include,
                                      [&](const std::string& allowed) { return isBelow(header, allowed); }))
          << file << " includes " << header;
    }
  }
  EXPECT_GT(between_rooms, 1000u);
}

TEST(Includes, everyRoomIsAFolder) {
  for (const Room& room : roomsOfTheMap()) {
    EXPECT_TRUE(std::filesystem::is_directory(kProject / room.folder)) << room.folder;
  }
}

/// All that a file includes, directly or not.
std::set<std::string> closureOf(const Includes& includes, const std::string& file) {
  std::set<std::string> closure;
  std::vector<std::string> open = {file};
  while (!open.empty()) {
    const auto here = includes.find(open.back());
    open.pop_back();
    if (here == includes.end()) continue;
    for (const std::string& next : here->second) {
      if (closure.insert(next).second) open.push_back(next);
    }
  }
  return closure;
}

TEST(Includes, geometryKnowsNoTree) {
  const std::vector<std::string> files = sourceFiles();
  const Includes includes = includesOf(files);
  const std::string tree = "core/include/octoblisk/clustered_octree.h";
  std::size_t looked_at = 0;
  for (const std::string& file : files) {
    for (const char* room : {"core/src/base", "core/src/geometry", "core/src/simd"}) {
      if (!isBelow(file, room)) continue;
      ++looked_at;
      EXPECT_FALSE(closureOf(includes, file).contains(tree)) << file;
    }
  }
  EXPECT_GT(looked_at, 30u);
  EXPECT_TRUE(closureOf(includes, "core/src/query/collide.cpp").contains(tree));
}

}  // namespace
}  // namespace octoblisk::house
