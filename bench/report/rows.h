// Rows of results, as stored in the JSON files of bench/results.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace octoblisk::bench {

/// One result: task, scene, contender and figures.
using Row = nlohmann::ordered_json;
using Rows = std::vector<Row>;

/// The contender that all others are compared with.
inline constexpr const char* kOurs = "octoblisk";

/// The contender's first row of a task and scene, or null.
const Row* findRow(const Rows& rows, const std::string& task, const std::string& scene,
                   const std::string& contender);

/// The rows of a file. The file is a JSON array of objects, each with a task and a scene. Returns no rows if
/// the file does not exist. Throws std::runtime_error naming the file and, if a row is invalid, that row.
Rows readRows(const std::filesystem::path& file);

/// The rows of all such files of a folder, in the order of their names. Skips machine.json, which describes
/// the machine.
Rows readAllRows(const std::filesystem::path& folder);

/// Writes one row per line. Throws std::runtime_error naming the file.
void writeRows(const std::filesystem::path& file, const Rows& rows);

/// The commit that the program was configured from, "-dirty" if files had changed; empty outside a checkout.
std::string commit();

/// Adds the rows of a run, with the commit, to a file. They replace the file's rows of the same task and
/// scene, because ratios between runs mean nothing. Throws std::runtime_error naming the file.
void addRows(const std::filesystem::path& file, Rows run);

}  // namespace octoblisk::bench
