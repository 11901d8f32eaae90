// Rows: the lines of the results, as JSON files of bench/results keep them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace octoblisk::bench {

/// A line of the results: task, scene, contender, and figures.
using Row = nlohmann::ordered_json;
using Rows = std::vector<Row>;

/// The one that all others are compared with.
inline constexpr const char* kOurs = "octoblisk";

/// The first row of a task and scene of that contender; null where there is none.
const Row* findRow(const Rows& rows, const std::string& task, const std::string& scene,
                   const std::string& contender);

/// The rows of a file: a JSON array of objects, each with a task and a scene. None where there is
/// no such file. Throws std::runtime_error that names the file and, where one is at fault, the row.
Rows readRows(const std::filesystem::path& file);

/// Of all such files of a folder, by name; machine.json, which tells where they were taken, is none.
Rows readAllRows(const std::filesystem::path& folder);

/// One a line. Throws std::runtime_error that names the file.
void writeRows(const std::filesystem::path& file, const Rows& rows);

/// The rows `before` without those of any task and scene that is in `anew`, then `anew`: what is told of a
/// scene is of one run, as ratios are worth nothing between runs.
Rows mergedRows(Rows before, const Rows& anew);

}  // namespace octoblisk::bench
