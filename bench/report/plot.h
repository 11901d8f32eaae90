// Plots, drawn by gnuplot: log–log ones, and values over time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::bench {

struct Curve {
  std::string name;
  std::vector<double> x = {}, y = {};  ///< as many of each, above 0 in a log–log plot
};

struct LogLogPlot {
  std::string title, x_label, y_label;
  std::vector<Curve> curves = {};
};

/// Curves over time, s, by a logarithmic scale of y. What is below `least`, 0 too, is drawn at it.
struct TimePanel {
  std::string y_label;
  double least = 0.0;
  std::vector<Curve> curves = {};
};

/// Panels, one below the other.
struct TimePlot {
  std::string title;
  std::vector<TimePanel> panels = {};
};

/// What makes gnuplot draw the plot as SVG: each curve's points, and the power law that fits them, whose
/// exponent is in the key. A curve with fewer than two different x has no law.
std::string gnuplotScript(const LogLogPlot& plot, const std::filesystem::path& file);
std::string gnuplotScript(const TimePlot& plot, const std::filesystem::path& file);

/// Throws std::runtime_error naming the file where gnuplot is missing or cannot draw it.
void draw(const LogLogPlot& plot, const std::filesystem::path& file);
void draw(const TimePlot& plot, const std::filesystem::path& file);

}  // namespace octoblisk::bench
