// The results page: tables of all rows, by task.
#pragma once

#include <string>
#include <vector>

#include "report/plot.h"
#include "report/rows.h"

namespace octoblisk::bench {

/// One contender per line, one scene per column. A cell has the mean time of a query, its ratio to ours, bold
/// if the contender is faster, and the number of answers that differ.
std::string taskTable(const Rows& rows, const std::string& task);

/// A growth plot: the rows of a task whose scenes start with `prefix`. An empty prefix means the scenes of
/// the blisk's sizes.
struct Growth {
  std::string task, prefix, title, x_label;
};

/// One curve for each contender: µs by `size`.
LogLogPlot growthPlot(const Rows& rows, const Growth& growth);

/// The fitted exponents of the curves, and the times at both ends.
std::string growthTable(const LogLogPlot& plot);

/// One variant per line, one query per column. A cell has the time relative to the default.
std::string ablationTable(const Rows& rows);

/// For each query and scene: our time, the lower bound, their ratio, the exact tests and the bytes.
std::string limitTable(const Rows& rows);

/// The paper's detection: time, range, false alarms and missed contacts.
std::string paperTable(const Rows& rows);

/// The rows in which another library is faster: its ratio, and what our query does: tests of boxes, leaf
/// pairs, triangles and exact ones, and the bytes that it reads. Empty if there are none.
std::string lostTable(const Rows& rows);

/// One scene and shape per line: time of a step, steps until all sleep, energy, depth, contacts and lost
/// bodies.
std::string dynamicsTable(const Rows& rows);

/// Kinetic energy and depth over time, one curve for each shape.
TimePlot dynamicsPlot(const Rows& rows, const std::string& scene);

/// The whole page and its plots by name. The machine and the versions come from the context in Google
/// Benchmark's JSON.
struct NamedPlot {
  std::string file;
  LogLogPlot plot;
};
struct NamedTimePlot {
  std::string file;
  TimePlot plot;
};
struct ResultsPage {
  std::string text;
  std::vector<NamedPlot> plots;
  std::vector<NamedTimePlot> time_plots;
};
ResultsPage resultsPage(const Rows& rows, const Row& context);

/// The part of docs/methods.md that is generated: a table of our times and the others' ratios, and the page's
/// plots, two per line. `results` is the folder of the plots.
std::string summary(const Rows& rows, const std::string& results);

}  // namespace octoblisk::bench
