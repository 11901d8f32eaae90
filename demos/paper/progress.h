// The progress of an experiment.
#pragma once

#include <functional>

namespace octoblisk::demos {

/// Called with the finished fraction of the work, 0 … 1.
using Progress = std::function<void(double part)>;

/// The progress of a step that is responsible for the work from one fraction to another.
inline Progress stretchOf(const Progress& whole, double from, double to) {
  return [whole, from, to](double part) { whole(from + part * (to - from)); };
}

}  // namespace octoblisk::demos
