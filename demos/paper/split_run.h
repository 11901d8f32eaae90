// A finished experiment of Tables 1 and 2, as input of the report.
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
  std::vector<SplitResult> of_seeds{};  ///< one per seed of clouds and clusters; without poses
};

/// Changes of a number of cubes along the axes compared with the traditional method's: mean, least and
/// greatest over the seeds; for each k the mean over FNOP, for the paper's optimum, and for all cells.
template <typename Number>
Table seedsTable(std::string name, const std::string& what, const SplitRun& run, Number SplitCell::*number) {
  Table table{.name = std::move(name),
              .caption = what + " compared with the traditional method, over " +
                         std::to_string(run.of_seeds.size()) +
                         " seeds of clouds and clusters; for each k the mean over FNOP 1–10",
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

/// All cells of both tables, one per row.
Table splitCells(const SplitRun& run);

}  // namespace octoblisk::demos
