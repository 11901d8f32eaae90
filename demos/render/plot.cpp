#include "render/plot.h"

#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "base/file.h"
#include "io/new_file.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr const char* kMissing =
    "gnuplot, which draws the plots, was not found: install it (on Debian 12: apt install gnuplot-nox)";

/// A gnuplot string without escapes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += c == '\n' || c == '\r' ? ' ' : c;
  }
  return result + '\'';
}

void requireUsable(const Series& series) {
  if (!series.x.empty() && series.x.size() == series.y.size()) return;
  throw std::invalid_argument("series '" + series.name + "' has " + std::to_string(series.x.size()) +
                              " x and " + std::to_string(series.y.size()) +
                              " y: it needs as many of each, and at least one");
}

std::string styleOf(SeriesStyle style) {
  switch (style) {
    case SeriesStyle::line:
      return "lines lw 2";
    case SeriesStyle::dashed_line:
      return "lines lw 2 dt 2";
    case SeriesStyle::points:
      return "points pt 7 ps 0.4";
    case SeriesStyle::line_and_points:
      return "linespoints lw 2 pt 7 ps 0.5";
  }
  return {};
}

std::string restOf(std::FILE* file) {
  std::string text;
  for (int byte = std::getc(file); byte != EOF; byte = std::getc(file)) text += static_cast<char>(byte);
  return text;
}

struct Answer {
  int exit_code = -1;
  std::string drawn;  ///< its standard output
  std::string words;  ///< its standard error
};

/// Runs gnuplot on the script, by the shell. The script and gnuplot's words are in nameless files.
Answer runGnuplot(const std::string& script) {
  constexpr int kNotFound = 127, kNotRun = 126;  // of the shell
  const auto refuse = [](int error) {
    throw std::runtime_error(std::string("gnuplot cannot be started (is it installed?): ") +
                             std::strerror(error));
  };
  const OpenFile input = openTemporary(), words = openTemporary();
  if (!input || !words || std::fputs(script.c_str(), input.get()) < 0 || std::fflush(input.get()) != 0) {
    refuse(errno);
  }
  const auto nameOf = [](const OpenFile& file) { return "/dev/fd/" + std::to_string(::fileno(file.get())); };
  std::FILE* const pipe = ::popen(("gnuplot <" + nameOf(input) + " 2>" + nameOf(words)).c_str(), "r");
  if (!pipe) refuse(errno);
  Answer answer;
  answer.drawn = restOf(pipe);
  const int status = ::pclose(pipe);
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (answer.exit_code == kNotFound) throw std::runtime_error(kMissing);
  if (answer.exit_code == kNotRun) refuse(EACCES);
  answer.words = restOf(words.get());
  return answer;
}

/// The last line that is not blank.
std::string lastLine(const std::string& text) {
  std::istringstream lines(text);
  std::string line, last = "gnuplot gave no reason";
  while (std::getline(lines, line)) {
    if (line.find_first_not_of(" \t\r^") != std::string::npos) last = line;
  }
  return last;
}

}  // namespace

std::string gnuplotScript(const Plot& plot) {
  if (plot.series.empty()) throw std::invalid_argument("plot '" + plot.title + "' has no series");
  std::ostringstream script;
  script.precision(10);
  script << "set encoding utf8\n"
         << "set terminal svg size 720,480 noenhanced font 'DejaVu Sans,14' background rgb 'white'\n"
         << "set title " << quoted(plot.title) << '\n'
         << "set xlabel " << quoted(plot.x_label) << '\n'
         << "set ylabel " << quoted(plot.y_label) << '\n'
         << "set key outside right top\nset grid lc rgb '#d5dae0' lt 1 lw 1\nset border lc rgb '#5c6675'\n";
  // Colours that the colour-blind can tell apart (Okabe and Ito, 2008).
  const std::array<const char*, 8> colors = {"#21262e", "#0072b3", "#d64000", "#009e73",
                                             "#e69e00", "#cc78a6", "#57b5e8", "#5c6675"};
  for (std::size_t i = 0; i < colors.size(); ++i) {
    script << "set linetype " << i + 1 << " lc rgb '" << colors[i] << "'\n";
  }
  script << "set linetype cycle " << colors.size() << '\n';
  if (plot.x_log) script << "set logscale x\n";
  if (plot.y_log) script << "set logscale y\n";
  if (plot.equal_aspect) script << "set size ratio -1\n";
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const Series& series = plot.series[s];
    requireUsable(series);
    script << "$series" << s << " << END_OF_SERIES\n";
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) {
        script << series.x[i] << ' ' << series.y[i];
      }
      script << '\n';  // a blank line interrupts the curve
    }
    script << "END_OF_SERIES\n";
  }
  script << "plot ";
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const Series& series = plot.series[s];
    script << (s > 0 ? ", " : "") << "$series" << s << " using 1:2 with " << styleOf(series.style) << " lt "
           << s + 1 << (series.name.empty() ? " notitle" : " title " + quoted(series.name));
  }
  script << '\n';
  return script.str();
}

void requireGnuplot() { runGnuplot(""); }

void writeSvg(const Plot& plot, const std::filesystem::path& file) {
  const Answer answer = runGnuplot(gnuplotScript(plot));
  if (answer.exit_code != 0 || answer.drawn.find("</svg>") == std::string::npos) {
    throw std::runtime_error(file.string() + ": gnuplot cannot draw the plot: " + lastLine(answer.words));
  }
  writeFile(file, answer.drawn);
}

}  // namespace octoblisk::demos
