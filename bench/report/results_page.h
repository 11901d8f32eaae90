// The results as one page: tables of all rows, by task.
#pragma once

#include <string>
#include <vector>

#include "report/plot.h"
#include "report/rows.h"

namespace octoblisk::bench {

/// One contender a line, one scene a column: the mean time of a question and its ratio to ours, bold where
/// the contender is faster; how many answers differ.
std::string taskTable(const Rows& rows, const std::string& task);

/// What grows: the rows of a task whose scenes are named by it, or, of none, those of the blisk's sizes.
struct Growth {
  std::string task, prefix, title, x_label;
};

/// Its points, by `size`: a curve a contender, µs.
LogLogPlot growthPlot(const Rows& rows, const Growth& growth);

/// The exponents that fit the curves, and the times at both ends.
std::string growthTable(const LogLogPlot& plot);

/// One variant a line, one query a column: times as slow as the default.
std::string ablationTable(const Rows& rows);

/// For each query and scene: ours, the bound, and how many times it ours is; bytes.
std::string limitTable(const Rows& rows);

/// The detection of the paper: time, range, false alarms, missed.
std::string paperTable(const Rows& rows);

/// One scene and shape a line: cost, rest, energy, depth, contacts, losses.
std::string dynamicsTable(const Rows& rows);

/// Kinetic energy and depth over time, a curve a shape.
TimePlot dynamicsPlot(const Rows& rows, const std::string& scene);

/// All of it, with the machine and the versions that Google Benchmark's JSON tells in its context, and the
/// plots by name.
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

/// What docs/methods.md shows: a table of ours and how many times as long others take, and the plots of the
/// page, two a line, in the folder `results`.
std::string summary(const Rows& rows, const std::string& results);

}  // namespace octoblisk::bench
