#include "paper/comparison_table.h"

#include <utility>

#include "io/number_text.h"

namespace octoblisk::demos {

std::string rangeText(double volume) { return fixedText(1e-4 * volume, 2); }

std::vector<Claim> comparisonClaims(const std::string& table, const DetectionTable& here,
                                    const DetectionTable& paper) {
  const auto range = [](const DetectionTable& of) {
    return changeText(of.traditional.range, of.improved.range);
  };
  const auto time = [](const DetectionTable& of) {
    return changeText(of.traditional.meanSeconds(), of.improved.meanSeconds());
  };
  return {{table + ": collision detection range, called accuracy in the paper", range(paper), range(here)},
          {table + ": collision detection time", time(paper), time(here)}};
}

Table comparisonTable(std::string name, std::string caption, const DetectionTable& here,
                      const DetectionTable& paper, int digits_of_seconds) {
  Table table{.name = std::move(name),
              .caption = std::move(caption),
              .columns = {"attribute", "run", "traditional, here", "improved, here", "change, here",
                          "traditional, paper", "improved, paper", "change, paper"},
              .rows = {}};
  const auto change = [](double from, double to) { return changeText(from, to, 2); };
  table.rows.push_back({"range (10⁴ mm³)", "all", rangeText(here.traditional.range),
                        rangeText(here.improved.range), change(here.traditional.range, here.improved.range),
                        rangeText(paper.traditional.range), rangeText(paper.improved.range),
                        change(paper.traditional.range, paper.improved.range)});
  const auto addTimes = [&](const std::string& run, const auto& secondsOf) {
    const double ours = secondsOf(here.traditional), ours_improved = secondsOf(here.improved);
    const double papers = secondsOf(paper.traditional), papers_improved = secondsOf(paper.improved);
    table.rows.push_back({"time (s)", run, fixedText(ours, digits_of_seconds),
                          fixedText(ours_improved, digits_of_seconds), change(ours, ours_improved),
                          fixedText(papers, 2), fixedText(papers_improved, 2),
                          change(papers, papers_improved)});
  };
  for (std::size_t run = 0; run < kRuns; ++run) {
    addTimes(std::to_string(run + 1),
             [run](const DetectionNumbers& numbers) { return numbers.seconds[run]; });
  }
  addTimes("average", [](const DetectionNumbers& numbers) { return numbers.meanSeconds(); });
  return table;
}

}  // namespace octoblisk::demos
