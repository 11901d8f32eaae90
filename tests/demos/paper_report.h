// The report on the paper, for the tests of its parts.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "paper/report.h"

namespace octoblisk::demos {

/// The report of one part, e.g. "table3", with its numbers under this name.
inline PaperReport reportOf(const std::string& part, const std::string& name, const nlohmann::json& numbers) {
  return paperReport({{"blade", "a blade"},
                      {"model", "a blisk"},
                      {"built_in", false},
                      {"seed", "1"},
                      {"lift", 1.0},
                      {"parts", nlohmann::json::array({part})},
                      {"notes", nlohmann::json::array()},
                      {name, numbers}});
}

inline const Table& tableOf(const PaperReport& report, const std::string& name) {
  for (const Section& section : report.document.sections) {
    const auto found = std::ranges::find(section.tables, name, &Table::name);
    if (found != section.tables.end()) return *found;
  }
  throw std::out_of_range("no table " + name);
}

}  // namespace octoblisk::demos
