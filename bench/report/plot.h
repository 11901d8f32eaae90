// Log–log plots, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::bench {

struct Curve {
  std::string name;
  std::vector<double> x = {}, y = {};  ///< as many of each, above 0
};

struct LogLogPlot {
  std::string title, x_label, y_label;
  std::vector<Curve> curves = {};
};

/// What makes gnuplot draw the plot as SVG: each curve's points, and the power law that fits them, whose
/// exponent is in the key. A curve with fewer than two different x has no law.
std::string gnuplotScript(const LogLogPlot& plot, const std::filesystem::path& file);

/// Throws std::runtime_error naming the file where gnuplot is missing or cannot draw it.
void draw(const LogLogPlot& plot, const std::filesystem::path& file);

}  // namespace octoblisk::bench
