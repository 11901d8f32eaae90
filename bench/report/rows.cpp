#include "report/rows.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace octoblisk::bench {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& fault) {
  throw std::runtime_error(file.string() + ": " + fault);
}

}  // namespace

Rows readRows(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return {};
  const Row parsed = Row::parse(in, nullptr, false);
  if (!parsed.is_array()) refuse(file, "is not a JSON array of rows");
  Rows rows(parsed.begin(), parsed.end());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (const char* key : {"task", "scene"}) {
      if (rows[k].is_object() && rows[k].contains(key) && rows[k][key].is_string()) continue;
      refuse(file, std::string("row ") + std::to_string(k) + " has no " + key);
    }
  }
  return rows;
}

Rows readAllRows(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() == ".json" && file.filename() != "machine.json") files.push_back(file);
  }
  std::ranges::sort(files);
  Rows rows;
  for (const std::filesystem::path& file : files) {
    for (Row& row : readRows(file)) rows.push_back(std::move(row));
  }
  return rows;
}

void writeRows(const std::filesystem::path& file, const Rows& rows) {
  std::ofstream out(file);
  out << "[\n";
  for (std::size_t k = 0; k < rows.size(); ++k) out << rows[k].dump() << (k + 1 < rows.size() ? ",\n" : "\n");
  out << "]\n";
  out.close();
  if (!out) refuse(file, "cannot be written");
}

const Row* findRow(const Rows& rows, const std::string& task, const std::string& scene,
                   const std::string& contender) {
  const auto row = std::ranges::find_if(rows, [&](const Row& r) {
    return r["task"] == task && r["scene"] == scene && r.value("contender", "") == contender;
  });
  return row == rows.end() ? nullptr : &*row;
}

std::string commit() { return OCTOBLISK_BENCH_COMMIT; }

void addRows(const std::filesystem::path& file, Rows run) {
  Rows rows = readRows(file);
  std::erase_if(rows, [&](const Row& old) {
    return std::ranges::any_of(
        run, [&](const Row& row) { return row["task"] == old["task"] && row["scene"] == old["scene"]; });
  });
  for (Row& row : run) {
    row["commit"] = commit();
    rows.push_back(std::move(row));
  }
  writeRows(file, rows);
}

}  // namespace octoblisk::bench
