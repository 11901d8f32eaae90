// Tables of a report with one column per FNOP.
#pragma once

#include <functional>
#include <string>

#include "io/number_text.h"
#include "paper/method_table.h"
#include "render/document.h"

namespace octoblisk::demos {

/// A table without rows.
Table fnopTable(std::string name, std::string caption);

/// Adds a row with that name.
void addRow(Table& table, const std::string& name,
            const std::function<std::string(std::size_t column)>& text);

/// A table with one row per method, named after it.
Table oneRowPerMethod(std::string name, std::string caption,
                      const std::function<std::string(std::size_t method, std::size_t column)>& text);

/// "-3.2 %": the mean change of the improved cells, each compared with the traditional cell of the same FNOP,
/// which may come from another table.
template <typename Number>
std::string meanChangeText(const MethodTable<Number>& improved, const MethodTable<Number>& traditional) {
  double ratio = 0.0;
  for (std::size_t m = 1; m < kMethods; ++m) {
    for (std::size_t c = 0; c < kFnops; ++c) {
      ratio += static_cast<double>(improved[m][c]) / static_cast<double>(traditional[0][c]);
    }
  }
  return changeText(1.0, ratio / kImprovedCells);
}

/// "48 of 70 cells": those with a number below the traditional method's.
template <typename Number>
std::string cellsBelowText(const MethodTable<Number>& table) {
  return std::to_string(cellsBelowTraditional(table)) + " of " + std::to_string(kImprovedCells) + " cells";
}

}  // namespace octoblisk::demos
