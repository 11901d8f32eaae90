#include "io/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

namespace octoblisk::demos {
namespace {

constexpr std::chrono::milliseconds kInterval{100};
constexpr std::size_t kBarWidth = 40;      ///< characters of the bar
constexpr const char* kWipe = "\r\x1b[K";  ///< goes to the beginning of the line and clears it

}  // namespace

ProgressBar::ProgressBar(std::ostream& stream, std::size_t total)
    : stream_(stream),
      total_(std::max<std::size_t>(total, 1)),
      shown_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      next_draw_(start_ + kInterval) {}  // short work shows no bar

ProgressBar::~ProgressBar() {
  if (drawn_) stream_ << kWipe << std::flush;
}

void ProgressBar::update(std::size_t done) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_draw_) return;
  next_draw_ = now + kInterval;
  draw(std::min(done, total_), now);
}

void ProgressBar::draw(std::size_t done, Clock::time_point now) {
  const double part = static_cast<double>(done) / static_cast<double>(total_);
  const auto filled = static_cast<std::size_t>(part * kBarWidth);
  const auto percent = static_cast<int>(part * 100.0);
  stream_ << kWipe << '[' << std::string(filled, '#') << std::string(kBarWidth - filled, '.') << "] "
          << percent << " %  "
          << rateAndTimeLeft(done, total_, std::chrono::duration<double>(now - start_).count()) << std::flush;
  drawn_ = true;
}

std::string rateAndTimeLeft(std::size_t done, std::size_t total, double seconds) {
  if (done == 0 || !(seconds > 0.0)) return {};
  const double rate = static_cast<double>(done) / seconds;
  const auto left = static_cast<long>(std::ceil(static_cast<double>(total - done) / rate));
  std::ostringstream text;
  text << std::fixed << std::setprecision(rate < 10.0 ? 1 : 0) << rate << " per second, ";
  if (left >= 3600) text << left / 3600 << " h ";
  if (left >= 60) text << left / 60 % 60 << " min ";
  text << left % 60 << " s left";
  return text.str();
}

}  // namespace octoblisk::demos
