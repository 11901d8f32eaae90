// Reads back tables that the command wrote.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "demos/command.h"

namespace octoblisk::demos {

/// The rows of a table by column name.
inline std::vector<std::map<std::string, std::string>> readTable(const std::filesystem::path& file) {
  std::istringstream stream(contentOf(file));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> found;
    std::size_t begin = 0;
    for (std::size_t comma; (comma = line.find(',', begin)) != std::string::npos; begin = comma + 1) {
      found.push_back(line.substr(begin, comma - begin));
    }
    found.push_back(line.substr(begin));
    return found;
  };
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = cells(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> values = cells(line);
    EXPECT_EQ(values.size(), header.size());
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(values.size(), header.size()); ++i)
      rows.back()[header[i]] = values[i];
  }
  return rows;
}

}  // namespace octoblisk::demos
