#include "paper/comparison_table.h"

#include <utility>

#include "io/number_text.h"
#include "paper/spread.h"

namespace octoblisk::demos {

std::string rangeText(double volume) { return fixedText(1e-4 * volume, 2); }

Table comparisonTable(std::string name, std::string caption, const DetectionTable& here,
                      const DetectionTable& paper, int digits_of_seconds) {
  Table table{.name = std::move(name),
              .caption = std::move(caption),
              .columns = {"attribute", "of the runs", "traditional, here", "improved, here", "change, here",
                          "traditional, paper", "improved, paper", "change, paper"},
              .rows = {}};
  const auto change = [](double from, double to) { return changeText(from, to, 2); };
  table.rows.push_back({"range (10⁴ mm³)", "all", rangeText(here.traditional.range),
                        rangeText(here.improved.range), change(here.traditional.range, here.improved.range),
                        rangeText(paper.traditional.range), rangeText(paper.improved.range),
                        change(paper.traditional.range, paper.improved.range)});
  const Spread ours = spreadOf(here.traditional.seconds), ours_improved = spreadOf(here.improved.seconds);
  const Spread papers = spreadOf(paper.traditional.seconds),
               papers_improved = spreadOf(paper.improved.seconds);
  const auto addTimes = [&](const std::string& run, double Spread::*time) {
    table.rows.push_back({"time (s)", run, fixedText(ours.*time, digits_of_seconds),
                          fixedText(ours_improved.*time, digits_of_seconds),
                          change(ours.*time, ours_improved.*time), fixedText(papers.*time, 2),
                          fixedText(papers_improved.*time, 2), change(papers.*time, papers_improved.*time)});
  };
  addTimes("least", &Spread::least);
  addTimes("median", &Spread::median);
  addTimes("greatest", &Spread::most);
  return table;
}

}  // namespace octoblisk::demos
