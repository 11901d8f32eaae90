// Plots drawn by gnuplot: log–log plots, and values over time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::bench {

struct Curve {
  std::string name;
  std::vector<double> x = {}, y = {};  ///< of the same length; above 0 in a log–log plot
};

struct LogLogPlot {
  std::string title, x_label, y_label;
  std::vector<Curve> curves = {};
};

/// Curves over time in s, with a logarithmic y axis. Values below `least`, including 0, are drawn at `least`.
struct TimePanel {
  std::string y_label;
  double least = 0.0;
  std::vector<Curve> curves = {};
};

/// Panels, stacked vertically.
struct TimePlot {
  std::string title;
  std::vector<TimePanel> panels = {};
};

/// A gnuplot script that draws the plot as SVG: each curve's points and its fitted power law. The key shows
/// the exponent. A curve with fewer than two different x has no law.
std::string gnuplotScript(const LogLogPlot& plot, const std::filesystem::path& file);
std::string gnuplotScript(const TimePlot& plot, const std::filesystem::path& file);

/// Throws std::runtime_error naming the file if gnuplot is missing or cannot draw it.
void draw(const LogLogPlot& plot, const std::filesystem::path& file);
void draw(const TimePlot& plot, const std::filesystem::path& file);

}  // namespace octoblisk::bench
