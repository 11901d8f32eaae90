#include "render/plot.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "io/new_file.h"

extern char** environ;

namespace octoblisk::demos {
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

class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

struct Answer {
  int exit_code = -1;
  std::string drawn;  ///< its standard output
  std::string words;  ///< its standard error
};

/// Sends the text and receives the answer at the same time, so that neither end blocks.
std::string sendAndReceive(int socket, std::string_view text) {
  std::string taken;
  std::array<char, 65536> buffer;
  bool sends = true;
  for (;;) {
    if (sends && text.empty()) {
      ::shutdown(socket, SHUT_WR);
      sends = false;
    }
    pollfd ready{socket, static_cast<short>(sends ? POLLIN | POLLOUT : POLLIN), 0};
    if (::poll(&ready, 1, -1) < 0 && errno != EINTR) return taken;
    if (sends && (ready.revents & POLLOUT) != 0) {
      const ssize_t sent = ::send(socket, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent > 0) text.remove_prefix(static_cast<std::size_t>(sent));
      if (sent < 0 && errno != EINTR && errno != EAGAIN)
        text = {};  // gnuplot has failed; its answer says why
    }
    if ((ready.revents & (POLLIN | POLLHUP | POLLERR)) == 0) continue;
    const ssize_t read = ::recv(socket, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (read < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (read <= 0) return taken;
    taken.append(buffer.data(), static_cast<std::size_t>(read));
  }
}

std::string wordsIn(int file) {
  std::string content;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t read = ::pread(file, buffer.data(), buffer.size(), static_cast<off_t>(content.size()));
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) return content;
    content.append(buffer.data(), static_cast<std::size_t>(read));
  }
}

/// Runs gnuplot on the script. The script is sent through a socket, not a pipe: if gnuplot has failed,
/// writing then gives an error instead of a signal.
Answer runGnuplot(std::string_view script) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::runtime_error(std::string("gnuplot cannot be started (is it installed?): ") +
                             std::strerror(errno));
  }
  FileDescriptor ours(ends[0]), its(ends[1]);
  const FileDescriptor words(::memfd_create("gnuplot", MFD_CLOEXEC));
  if (words.number() < 0) {
    throw std::runtime_error(std::string("gnuplot cannot be started (is it installed?): ") +
                             std::strerror(errno));
  }
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (const int stream : {0, 1}) ::posix_spawn_file_actions_adddup2(&actions, its.number(), stream);
  ::posix_spawn_file_actions_adddup2(&actions, words.number(), 2);
  std::string name = "gnuplot";
  std::array<char*, 2> arguments = {name.data(), nullptr};
  pid_t process = 0;
  const int failure = ::posix_spawnp(&process, "gnuplot", &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT) throw std::runtime_error(kMissing);
  if (failure != 0)
    throw std::runtime_error(std::string("gnuplot cannot be started (is it installed?): ") +
                             std::strerror(failure));
  its.close();

  Answer answer;
  answer.drawn = sendAndReceive(ours.number(), script);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  answer.words = wordsIn(words.number());
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
