#include "report/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <string>

namespace octoblisk::demos {
namespace {

constexpr std::chrono::milliseconds kInterval{100};
constexpr std::size_t kBarWidth = 40;      ///< characters of the bar
constexpr const char* kWipe = "\r\x1b[K";  ///< to the line's begin, and clear it to its end

}  // namespace

ProgressBar::ProgressBar(std::ostream& stream, std::size_t total)
    : stream_(stream),
      total_(std::max<std::size_t>(total, 1)),
      shown_(isatty(STDERR_FILENO) == 1),
      next_draw_(Clock::now() + kInterval) {}  // short work shows no bar

ProgressBar::~ProgressBar() {
  if (drawn_) stream_ << kWipe << std::flush;
}

void ProgressBar::update(std::size_t done) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_draw_) return;
  next_draw_ = now + kInterval;
  draw(std::min(done, total_));
}

void ProgressBar::draw(std::size_t done) {
  const double part = static_cast<double>(done) / static_cast<double>(total_);
  const auto filled = static_cast<std::size_t>(part * kBarWidth);
  const auto percent = static_cast<int>(part * 100.0);
  stream_ << kWipe << '[' << std::string(filled, '#') << std::string(kBarWidth - filled, '.') << "] "
          << percent << " %" << std::flush;
  drawn_ = true;
}

}  // namespace octoblisk::demos
