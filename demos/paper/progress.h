// How an experiment tells how far it has come.
#pragma once

#include <functional>

namespace octoblisk::demos {

/// Called with the part of the work that is done, 0 … 1.
using Progress = std::function<void(double part)>;

/// The progress of a piece of work that takes the whole from one part to another.
inline Progress stretchOf(const Progress& whole, double from, double to) {
  return [whole, from, to](double part) { whole(from + part * (to - from)); };
}

}  // namespace octoblisk::demos
