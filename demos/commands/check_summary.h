// The summary that octoblisk check prints at its end.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <ostream>
#include <span>
#include <string>

#include "study/study.h"
#include "toolpath/pose_check.h"

namespace octoblisk::demos {

/// A least or greatest value, and the pose that has it.
struct Extreme {
  double value = 0.0;
  std::size_t pose = 0;
};

struct CheckSummary {
  std::size_t poses = 0;
  std::size_t colliding = 0;         ///< poses where the surfaces meet
  std::size_t inside = 0;            ///< poses where they do not meet, but one mesh is inside the other
  std::size_t motions = 0;           ///< motions from a pose to the next
  std::size_t motions_not_free = 0;  ///< motions that come within the tolerance
  std::size_t unsettled = 0;         ///< those of them that are not proved either way
  std::optional<Extreme> least_clearance, greatest_depth, least_signed;

  bool isClean() const { return colliding + inside + motions_not_free == 0; }

  void count(std::size_t pose, const PoseAnswer& answer, const PoseCheckOptions& options);
  void add(const CheckSummary& later);  ///< the summary of later poses
};

/// The study's name in the part files.
inline constexpr const char* kCheckName = "check";

/// Converts to one line and back. Throws std::invalid_argument for any other line.
std::string tallyOf(const CheckSummary& summary);
CheckSummary summaryOfTally(const std::string& tally);

/// The tallies must be in order.
CheckSummary summaryOfTallies(std::span<const std::string> tallies);

/// Converts the options that a summary depends on to the study's line of options and back. Throws
/// std::invalid_argument for any other line.
std::string optionsLine(const PoseCheckOptions& options);
PoseCheckOptions optionsOfLine(const std::string& line);

/// `time_per_pose` is the time per pose, if known.
void print(std::ostream& stream, const CheckSummary& summary, const PoseCheckOptions& options,
           std::optional<std::chrono::duration<double, std::micro>> time_per_pose);

}  // namespace octoblisk::demos
