// A finished experiment of Tables 1 and 2, as the report needs it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "paper/split_experiment.h"
#include "paper/spread.h"
#include "render/document.h"

namespace octoblisk::demos {

struct SplitRun {
  std::string blade_name;
  std::size_t points = 0;
  SplitResult result;
  std::vector<SplitResult> of_seeds{};  ///< of clouds and clusters; without poses
};

/// Mean, least and most, over the seeds, of the changes of a number of cubes along the axes against the
/// traditional method's: of each k the mean over FNOP, of the paper's optimum, and of all cells.
template <typename Number>
Table seedsTable(std::string name, const std::string& what, const SplitRun& run, Number SplitCell::*number) {
  Table table{.name = std::move(name),
              .caption = what + " against the traditional method, over " +
                         std::to_string(run.of_seeds.size()) +
                         " seeds of clouds and clusters; of each k the "
                         "mean over FNOP 1–10",
              .columns = {"cells", "mean", "least", "most"},
              .rows = {}};
  const auto add = [&](const std::string& cells, const auto& ratioOf) {
    std::vector<double> ratios;
    for (const SplitResult& result : run.of_seeds) ratios.push_back(ratioOf(numbersOf(result.cubes, number)));
    const Spread spread = spreadOf(ratios);
    table.rows.push_back(
        {cells, changeText(1.0, spread.mean), changeText(1.0, spread.least), changeText(1.0, spread.most)});
  };
  for (std::size_t method = 1; method < kMethods; ++method) {
    add(nameOfMethod(method), [method](const auto& numbers) { return meanRatio(numbers, method); });
  }
  add("k = 2, FNOP 2",
      [](const auto& numbers) { return ratioToTraditional(numbers, methodOfClusters(2), columnOfFnop(2)); });
  add("all", [](const auto& numbers) {
    double sum = 0.0;
    for (std::size_t method = 1; method < kMethods; ++method) sum += meanRatio(numbers, method);
    return sum / (kMethods - 1);
  });
  return table;
}

/// All cells of both tables, one a row.
Table splitCells(const SplitRun& run);

}  // namespace octoblisk::demos
