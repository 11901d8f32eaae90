#include "report/plot.h"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "report/markdown.h"
#include "report/power_law.h"

namespace octoblisk::bench {
namespace {

/// A gnuplot string without escapes.
std::string inQuotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + '\'';
}

bool hasLaw(const Curve& curve) { return curve.x.size() > 1 && curve.x.front() != curve.x.back(); }

/// The common start of all plots.
std::string head(const std::string& title, int height, const std::filesystem::path& file) {
  return "set encoding utf8\nset terminal svg size 720," + std::to_string(height) +
         " noenhanced font 'DejaVu Sans,14' background rgb 'white'\nset output " + inQuotes(file.string()) +
         "\nset title " + inQuotes(title) +
         "\nset key outside right top\nset grid lc rgb '#d5dae0' lt 1 lw 1\n";
}

/// Colours that colour-blind readers can tell apart (Okabe and Ito, 2008).
std::string colorOf(std::size_t curve) {
  const char* colors[] = {"#0072b3", "#d64000", "#009e73", "#e69e00", "#cc78a6", "#57b5e8"};
  return std::string(" lc rgb '") + colors[curve % std::size(colors)] + "'";
}

void drawScript(const std::string& script, const std::filesystem::path& file) {
  std::FILE* gnuplot = popen("gnuplot", "w");
  if (gnuplot == nullptr) throw std::runtime_error(file.string() + ": cannot start gnuplot");
  const bool is_written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  if (pclose(gnuplot) != 0 || !is_written) {
    throw std::runtime_error(file.string() +
                             ": gnuplot cannot draw it. On Debian 12: apt install gnuplot-nox");
  }
}

}  // namespace

std::string gnuplotScript(const LogLogPlot& plot, const std::filesystem::path& file) {
  std::ostringstream script;
  script.precision(10);
  script << head(plot.title, 480, file) << "set xlabel " << inQuotes(plot.x_label) << "\nset ylabel "
         << inQuotes(plot.y_label) << "\nset logscale xy\nset format x '%.0s%c'\n";
  std::string plots;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const Curve& curve = plot.curves[c];
    const std::string color = colorOf(c);
    const std::string data = "$curve" + std::to_string(c);
    script << data << " << END_OF_CURVE\n";
    for (std::size_t k = 0; k < curve.x.size(); ++k) script << curve.x[k] << ' ' << curve.y[k] << '\n';
    script << "END_OF_CURVE\n";
    std::string title = curve.name;
    if (hasLaw(curve)) {
      const PowerLaw law = fitPowerLaw(curve.x, curve.y);
      title += std::string(": ^") + significant(law.exponent);
      std::ostringstream formula;
      formula.precision(10);
      formula << ", [" << curve.x.front() << ':' << curve.x.back() << "] " << law.factor << "*x**("
              << law.exponent << ") with lines lw 1 dt 2" << color << " notitle";
      plots += formula.str();
    }
    plots +=
        std::string(", ") + data + " using 1:2 with points pt 7 ps 0.6" + color + " title " + inQuotes(title);
  }
  script << "plot" << plots.substr(1) << "\nset output\n";
  return script.str();
}

std::string gnuplotScript(const TimePlot& plot, const std::filesystem::path& file) {
  std::ostringstream script;
  script.precision(10);
  script << head(plot.title, 300 * static_cast<int>(plot.panels.size()), file)
         << "set logscale y\nset format y '%.0e'\nset multiplot layout " << plot.panels.size() << ",1\n";
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    const TimePanel& panel = plot.panels[p];
    script << "set ylabel " << inQuotes(panel.y_label) << '\n';
    if (p > 0) script << "unset title\n";
    if (p + 1 == plot.panels.size()) script << "set xlabel 's'\n";
    std::string plots;
    for (std::size_t c = 0; c < panel.curves.size(); ++c) {
      const Curve& curve = panel.curves[c];
      const std::string data = "$panel" + std::to_string(p) + "curve" + std::to_string(c);
      script << data << " << END_OF_CURVE\n";
      for (std::size_t k = 0; k < curve.x.size(); ++k)
        script << curve.x[k] << ' ' << std::max(curve.y[k], panel.least) << '\n';
      script << "END_OF_CURVE\n";
      plots += ", " + data + " using 1:2 with lines lw 2" + colorOf(c) + " title " + inQuotes(curve.name);
    }
    if (!plots.empty()) script << "plot" << plots.substr(1) << '\n';
  }
  script << "unset multiplot\nset output\n";
  return script.str();
}

void draw(const LogLogPlot& plot, const std::filesystem::path& file) {
  drawScript(gnuplotScript(plot, file), file);
}

void draw(const TimePlot& plot, const std::filesystem::path& file) {
  drawScript(gnuplotScript(plot, file), file);
}

}  // namespace octoblisk::bench
