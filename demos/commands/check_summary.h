// What a run of octoblisk check tells at its end.
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

/// The most remarkable of the poses' numbers.
struct Extreme {
  double value = 0.0;
  std::size_t pose = 0;
};

struct CheckSummary {
  std::size_t poses = 0;
  std::size_t colliding = 0;       ///< surfaces meet
  std::size_t inside = 0;          ///< they do not, yet one mesh lies in the other
  std::size_t ways = 0;            ///< from a pose to the next
  std::size_t met_on_the_way = 0;  ///< ways that come within the tolerance
  std::size_t unsettled = 0;       ///< of these, not proved either way
  std::optional<Extreme> least_clearance, greatest_depth, least_signed;

  bool isClean() const { return colliding + inside + met_on_the_way == 0; }

  void count(std::size_t pose, const PoseAnswer& answer, const PoseCheckOptions& options);
  void add(const CheckSummary& later);  ///< of poses behind these
};

/// The name of its studies.
inline constexpr const char* kCheckName = "check";

/// One line, and back. Throws std::invalid_argument where the line is another.
std::string tallyOf(const CheckSummary& summary);
CheckSummary summaryOfTally(const std::string& tally);

/// In order.
CheckSummary summaryOfTallies(std::span<const std::string> tallies);

/// What a summary must know of the options, as the study's line of options; and back.
/// Throws std::invalid_argument where the line is another.
std::string optionsLine(const PoseCheckOptions& options);
PoseCheckOptions optionsOfLine(const std::string& line);

/// `a_pose` is the time that a pose took, if that is known.
void tell(std::ostream& stream, const CheckSummary& summary, const PoseCheckOptions& options,
          std::optional<std::chrono::duration<double, std::micro>> a_pose);

}  // namespace octoblisk::demos
