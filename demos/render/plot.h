// Draws plots of numbers as SVG files with gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::demos {

enum class SeriesStyle { line, dashed_line, points, line_and_points };

struct Series {
  std::string name;  ///< in the key; empty: not in the key
  std::vector<double> x{};
  std::vector<double> y{};  ///< as many as x; a NaN interrupts the curve
  SeriesStyle style = SeriesStyle::line_and_points;
};

/// All text is plain UTF-8.
struct Plot {
  std::string title;
  std::string x_label{};  ///< with its unit
  std::string y_label{};
  bool x_log = false;
  bool y_log = false;
  bool equal_aspect = false;  ///< whether a unit of x is as long as a unit of y
  std::vector<Series> series{};
};

/// The script with which gnuplot writes the plot to its standard output. Throws std::invalid_argument naming
/// a series without points, or with different numbers of x and y.
std::string gnuplotScript(const Plot& plot);

/// Throws std::runtime_error with a one-line message that names the Debian package if gnuplot is not
/// installed.
void requireGnuplot();

/// Writes the plot as an SVG file. Throws as above, and std::runtime_error naming a file that cannot be
/// written or drawn.
void writeSvg(const Plot& plot, const std::filesystem::path& file);

}  // namespace octoblisk::demos
