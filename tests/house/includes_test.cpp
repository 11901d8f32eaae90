// Includes point down the map of CONTRIBUTING.md. Its table lists the modules from the bottom to the top and
// what each may include.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
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
struct Module {
  std::string folder;
  std::vector<std::string> may_include;
};

/// The rows of the map. "above" in a row stands for all rows above it with the same first folder.
std::vector<Module> modulesOfTheMap() {
  std::vector<Module> modules;
  std::istringstream lines(contentOf("CONTRIBUTING.md"));
  static const std::regex row(R"(\| `([a-z_/]+)` \|[^|]*\|([^|]*)\|)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    Module module{match[1], found(match[2], "`([a-z_/]+)`")};
    if (match[2].str().find("above") != std::string::npos) {
      const std::string first = module.folder.substr(0, module.folder.find('/'));
      for (const Module& above : modules) {
        if (isBelow(above.folder, first)) module.may_include.push_back(above.folder);
      }
    }
    modules.push_back(std::move(module));
  }
  return modules;
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

/// The innermost module that the file is in.
const Module* moduleOf(const std::vector<Module>& modules, const std::string& file) {
  const Module* innermost = nullptr;
  for (const Module& module : modules) {
    if (isBelow(file, module.folder) && (!innermost || module.folder.size() > innermost->folder.size()))
      innermost = &module;
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
  const std::vector<Module> modules = modulesOfTheMap();
  ASSERT_GT(modules.size(), 20u);
  const std::vector<std::string> files = sourceFiles();
  ASSERT_GT(files.size(), 500u);
  std::size_t between_modules = 0;
  for (const auto& [file, included] : includesOf(files)) {
    const Module* module = moduleOf(modules, file);
    ASSERT_TRUE(module) << file << " is in no module of CONTRIBUTING.md";
    for (const std::string& header : included) {
      const Module* other = moduleOf(modules, header);
      ASSERT_TRUE(other) << header << " is in no module of CONTRIBUTING.md";
      if (module == other) continue;
      ++between_modules;
      EXPECT_TRUE(std::ranges::any_of(module->may_include,
                                      [&](const std::string& allowed) { return isBelow(header, allowed); }))
          << file << " includes " << header;
    }
  }
  EXPECT_GT(between_modules, 1000u);
}

TEST(Includes, everyModuleIsAFolder) {
  for (const Module& module : modulesOfTheMap()) {
    EXPECT_TRUE(std::filesystem::is_directory(kProject / module.folder)) << module.folder;
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
    for (const char* module : {"core/src/base", "core/src/geometry", "core/src/simd"}) {
      if (!isBelow(file, module)) continue;
      ++looked_at;
      EXPECT_FALSE(closureOf(includes, file).contains(tree)) << file;
    }
  }
  EXPECT_GT(looked_at, 30u);
  EXPECT_TRUE(closureOf(includes, "core/src/query/collide.cpp").contains(tree));
}

}  // namespace
}  // namespace octoblisk::house
