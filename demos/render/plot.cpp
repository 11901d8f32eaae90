#include "render/plot.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "base/file.h"
#include "io/new_file.h"

extern char** environ;

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
  for (;;) {
    const int byte = std::getc(file);
    if (byte != EOF) {
      text += static_cast<char>(byte);
    } else if (std::ferror(file) != 0 && errno == EINTR) {
      std::clearerr(file);
    } else {
      return text;
    }
  }
}

struct Answer {
  int exit_code = -1;
  std::string drawn;  ///< its standard output
  std::string words;  ///< its standard error
};

/// Runs gnuplot on the script. The script is sent through a socket, not a pipe: if gnuplot has failed,
/// sending then gives an error instead of a signal. No file takes part, so a full disk does not matter.
Answer runGnuplot(std::string_view script) {
  const auto refuse = [](int error) {
    throw std::runtime_error(std::string("gnuplot cannot be started (is it installed?): ") +
                             std::strerror(error));
  };
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) refuse(errno);
  const OpenFile ours(::fdopen(ends[0], "rb"));
  OpenFile its(::fdopen(ends[1], "rb"));
  const OpenFile words(::fdopen(::memfd_create("gnuplot", MFD_CLOEXEC), "rb"));
  if (!words) refuse(errno);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (const int stream : {0, 1}) ::posix_spawn_file_actions_adddup2(&actions, ends[1], stream);
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(words.get()), 2);
  std::string name = "gnuplot";
  std::array<char*, 2> arguments = {name.data(), nullptr};
  pid_t process = 0;
  const int failure = ::posix_spawnp(&process, "gnuplot", &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT) throw std::runtime_error(kMissing);
  if (failure != 0) refuse(failure);
  its.reset();

  // gnuplot draws at the script's last line, so it never waits for its answer to be read before then.
  while (!script.empty()) {
    const ssize_t sent = ::send(ends[0], script.data(), script.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EINTR) break;  // gnuplot has failed; its words say why
    script.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(sent, 0)));
  }
  ::shutdown(ends[0], SHUT_WR);
  Answer answer;
  answer.drawn = restOf(ours.get());
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  std::rewind(words.get());  // gnuplot has moved the position that both share
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
