#include "commands/check_summary.h"

#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "io/number_text.h"
#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

const std::string kClearanceWord = "clearance", kDepthWord = "depth", kSignedWord = "signed",
                  kContinuousWord = "continuous", kToleranceWord = "tolerance", kMinWord = "least",
                  kGreatestWord = "greatest", kMinSignedWord = "least-signed";

void keepLess(std::optional<Extreme>& kept, const std::optional<Extreme>& later) {
  if (later && (!kept || later->value < kept->value)) kept = later;
}

void keepGreater(std::optional<Extreme>& kept, const std::optional<Extreme>& later) {
  if (later && (!kept || later->value > kept->value)) kept = later;
}

}  // namespace

void CheckSummary::count(std::size_t pose, const PoseAnswer& answer, const PoseCheckOptions& options) {
  ++poses;
  colliding += answer.touching.has_value();
  inside += !answer.touching && (answer.depth.value_or(0.0) > 0.0 ||
                                 (answer.signed_distance && answer.signed_distance->distance < 0.0));
  motions += options.continuous && pose > 0;
  motions_not_free += answer.hit_on_motion.has_value();
  unsettled += answer.hit_on_motion && !answer.hit_on_motion->converged;
  if (answer.clearance) keepLess(least_clearance, Extreme{*answer.clearance, pose});
  if (answer.depth) keepGreater(greatest_depth, Extreme{*answer.depth, pose});
  if (answer.signed_distance) keepLess(least_signed, Extreme{answer.signed_distance->distance, pose});
}

void CheckSummary::add(const CheckSummary& later) {
  poses += later.poses;
  colliding += later.colliding;
  inside += later.inside;
  motions += later.motions;
  motions_not_free += later.motions_not_free;
  unsettled += later.unsettled;
  keepLess(least_clearance, later.least_clearance);
  keepGreater(greatest_depth, later.greatest_depth);
  keepLess(least_signed, later.least_signed);
}

std::string tallyOf(const CheckSummary& summary) {
  std::string line = std::to_string(summary.poses);
  for (const std::size_t number :
       {summary.colliding, summary.inside, summary.motions, summary.motions_not_free, summary.unsettled}) {
    line += ' ' + std::to_string(number);
  }
  const auto append = [&](const std::string& name, const std::optional<Extreme>& extreme) {
    if (!extreme) return;
    line += ' ' + name + ' ' + exactText(extreme->value) + ' ' + std::to_string(extreme->pose);
  };
  append(kMinWord, summary.least_clearance);
  append(kGreatestWord, summary.greatest_depth);
  append(kMinSignedWord, summary.least_signed);
  return line;
}

CheckSummary summaryOfTally(const std::string& tally) {
  CheckSummary summary;
  std::istringstream words(tally);
  words >> summary.poses >> summary.colliding >> summary.inside >> summary.motions >>
      summary.motions_not_free >> summary.unsettled;
  bool is_right = !words.fail();
  for (std::string name; is_right && words >> name;) {
    Extreme extreme;
    std::optional<Extreme>* kept = name == kMinWord         ? &summary.least_clearance
                                   : name == kGreatestWord  ? &summary.greatest_depth
                                   : name == kMinSignedWord ? &summary.least_signed
                                                            : nullptr;
    is_right = kept && words >> extreme.value >> extreme.pose;
    if (is_right) *kept = extreme;
  }
  if (!is_right) throw std::invalid_argument("has a tally that is not from check: " + inQuotes(tally));
  return summary;
}

CheckSummary summaryOfTallies(std::span<const std::string> tallies) {
  CheckSummary summary;
  for (const std::string& tally : tallies) summary.add(summaryOfTally(tally));
  return summary;
}

std::string optionsLine(const PoseCheckOptions& options) {
  std::string line;
  const auto append = [&](const std::string& word) { line += (line.empty() ? "" : " ") + word; };
  if (options.clearance) append(kClearanceWord);
  if (options.depth) append(kDepthWord);
  if (options.signed_distance) append(kSignedWord);
  if (options.continuous) append(kContinuousWord);
  if (options.depth || options.signed_distance || options.continuous)
    append(kToleranceWord + ' ' + exactText(options.tolerance));
  return line.empty() ? "none" : line;
}

PoseCheckOptions optionsOfLine(const std::string& line) {
  PoseCheckOptions options;
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    options.clearance |= word == kClearanceWord;
    options.depth |= word == kDepthWord;
    options.signed_distance |= word == kSignedWord;
    options.continuous |= word == kContinuousWord;
    if (word == kToleranceWord) words >> options.tolerance;
  }
  // The line must match exactly, so a line that is only partly understood is refused.
  if (optionsLine(options) != line)
    throw std::invalid_argument("has options that are not from check: " + inQuotes(line));
  return options;
}

void print(std::ostream& stream, const CheckSummary& summary, const PoseCheckOptions& options,
           std::optional<std::chrono::duration<double, std::micro>> time_per_pose) {
  stream << countedText(summary.poses, "pose", "poses") << ": " << summary.colliding << " colliding, ";
  if (options.depth || options.signed_distance)
    stream << summary.inside << " with one mesh wholly inside the other, ";
  stream << summary.poses - summary.colliding - summary.inside << " clear";
  if (time_per_pose) {
    stream << "; " << std::fixed << std::setprecision(2) << time_per_pose->count() << " us per pose"
           << std::defaultfloat << std::setprecision(6);
  }
  stream << '\n';
  if (const auto& least = summary.least_clearance) {
    stream << "Least clearance: " << least->value << " at pose " << least->pose << '\n';
  }
  if (const auto& greatest = summary.greatest_depth) {
    stream << "Greatest depth: " << greatest->value << " at pose " << greatest->pose << '\n';
  }
  if (const auto& least = summary.least_signed) {
    stream << "Least signed distance: " << least->value << " at pose " << least->pose << '\n';
  }
  if (options.continuous) {
    stream << countedText(summary.motions, "motion", "motions")
           << " between poses: " << summary.motions - summary.motions_not_free << " free, "
           << summary.motions_not_free << " not proved to keep " << options.tolerance;
    if (summary.motions_not_free > 0) {
      stream << " (" << summary.motions_not_free - summary.unsettled << " come nearer, " << summary.unsettled
             << " undecided)";
    }
    stream << '\n';
  }
}

}  // namespace octoblisk::demos
