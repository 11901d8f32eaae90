#include "paper/split_plots.h"

#include <utility>

#include "paper/published.h"
#include "render/plot.h"

namespace octoblisk::demos {
namespace {

template <typename Number>
Plot plotOf(const MethodTable<Number>& table, std::string title, std::string y_label) {
  Plot plot{
      .title = std::move(title), .x_label = "FNOP (points)", .y_label = std::move(y_label), .series = {}};
  for (std::size_t m = 0; m < kMethods; ++m) {
    Series series{.name = nameOfMethod(m), .x = {}, .y = {}};
    for (std::size_t c = 0; c < kFnops; ++c) {
      series.x.push_back(static_cast<double>(fnopOf(c)));
      series.y.push_back(static_cast<double>(table[m][c]));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Plots the change compared with the traditional method, which shows the differences.
template <typename Number>
Plot changePlotOf(const MethodTable<Number>& table, std::string title, std::string y_label) {
  Plot plot = plotOf(table, std::move(title), std::move(y_label));
  for (std::size_t m = kMethods; m-- > 0;) {
    for (std::size_t c = 0; c < kFnops; ++c) {
      plot.series[m].y[c] = 100.0 * (plot.series[m].y[c] / plot.series[0].y[c] - 1.0);
    }
  }
  plot.series[0].style = SeriesStyle::line;
  return plot;
}

}  // namespace

Section splitPlotsSection(const SplitRun& run, const std::filesystem::path& folder) {
  Section section{.title = "Figures 9 and 10"};
  const auto add = [&](const std::string& file, const Plot& plot, const std::string& caption) {
    writeSvg(plot, folder / file);
    section.figures.push_back({file, caption});
  };
  const auto nodes = numbersOf(run.result.cubes, &SplitCell::nodes);
  const auto times = numbersOf(run.result.cubes, &SplitCell::split_ms);
  const std::string change = "change compared with the traditional method (%)";
  add("fig9.svg", plotOf(nodes, "Total number of nodes, here", "TNON (nodes)"),
      "Figure 9: nodes over FNOP for each k, cubes along the axes");
  add("fig9_change.svg", changePlotOf(nodes, "Nodes against the traditional method, here", change),
      "Figure 9 as changes: below 0, clustering makes fewer nodes");
  add("fig9_change_paper.svg",
      changePlotOf(kPublishedNodes, "Nodes against the traditional method, in the paper", change),
      "The same for the paper's Table 1");
  add("fig10.svg", plotOf(times, "Split time, here", "split time (ms)"),
      "Figure 10: split times over FNOP for each k, cubes along the axes");
  add("fig10_change.svg", changePlotOf(times, "Split time against the traditional method, here", change),
      "Figure 10 as changes: below 0, clustering is faster");
  add("fig10_change_paper.svg",
      changePlotOf(kPublishedSeconds, "Split time against the traditional method, in the paper", change),
      "The same for the paper's Table 2: the cells at FNOP 2 stand out, because their traditional time does "
      "(erratum 11)");
  return section;
}

}  // namespace octoblisk::demos
