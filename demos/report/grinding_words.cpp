#include "report/grinding_words.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "grinding/motion_check.h"
#include "io/number_text.h"
#include "report/grinding_pictures.h"
#include "report/grinding_report.h"

namespace octoblisk::demos {
namespace {

/// "poses 20-79, 228": the runs that interfere; only the first of them if there are many.
std::string listOf(const std::vector<PoseRange>& ranges) {
  constexpr std::size_t kMaxRuns = 12;
  std::ostringstream text;
  text << (ranges.size() == 1 && ranges[0].first == ranges[0].last ? "pose " : "poses ");
  for (std::size_t i = 0; i < std::min(ranges.size(), kMaxRuns); ++i) {
    text << (i > 0 ? ", " : "") << ranges[i].first;
    if (ranges[i].last != ranges[i].first) text << '-' << ranges[i].last;
  }
  if (ranges.size() > kMaxRuns)
    text << " and " << countedText(ranges.size() - kMaxRuns, "more run", "more runs") << " (summary.json)";
  return text.str();
}

void writeMotionCounts(const GrindingRun& run, std::ostream& text) {
  using Outcome = MotionReport::Outcome;
  const std::size_t hits = run.count(Outcome::hit), deep = run.count(Outcome::too_deep),
                    open = run.count(Outcome::not_proved), unchecked = run.count(Outcome::not_checked);
  text << "Between the poses: ";
  if (hits + deep + open == 0) {
    text << "no touch other than at the poses";
  } else {
    text << "motions that hit a forbidden surface: " << hits << ", that are too deep: " << deep
         << ", undecided within " << kMotionTolerance << " mm: " << open;
  }
  if (unchecked > 0) text << "; not checked, because a part interferes at one of the poses: " << unchecked;
  text << '\n';
  if (hits + deep + open == 0) return;
  const auto first = std::ranges::find_if(
      run.poses, [](const PoseReport& pose) { return pose.motion && pose.motion->hasFinding(); });
  text << "First: after " << first->motion->fraction << " of the motion to pose " << first - run.poses.begin()
       << ", " << run.job.parts[first->motion->at.part].name << " on "
       << run.names().nameOf(first->motion->at.blade) << '\n';
}

}  // namespace

std::string summaryText(const GrindingRun& run) {
  std::ostringstream text;
  const int blade = run.job.rules.ground_blade;
  const std::string blades = std::to_string(run.job.blades.count);
  if (run.isPartial())
    text << "Stopped: " << run.poses.size() << " of " << run.job.path.size() << " poses were checked\n";
  text << run.poses.size() << (run.poses.size() == 1 ? " pose, " : " poses, ");
  if (blade == 0) {
    text << "no blade ground (the blisk has " << blades << ")";
  } else {
    text << "ground blade " << blade << " of " << blades;
    if (run.job.rules.grinding_part != kNoPart) {
      text << " (intended up to " << run.job.rules.maxDepth(run.job.rules.grinding_part) << " mm deep)";
    }
  }
  text << ": " << run.count(Verdict::clear) << " clear, " << run.count(Verdict::intended_contact)
       << " intended contact, " << run.count(Verdict::near_miss) << " near miss, "
       << run.count(Verdict::interference) << " interference";
  if (const std::size_t unknown = run.count(Verdict::unknown); unknown > 0) {
    text << ", " << unknown << " unknown (the depth is unknown: the blisk's mesh has a hole near the tool)";
  }
  text << '\n';
  if (run.job.blisk->options().partition == PartitionKind::paper) {
    text << "Partition: " << partitionText(run.job.blisk->options()) << "; tree built in " << run.tree_seconds
         << " s, contacts in " << run.per_pose.contacts * 1e6 << " us per pose\n";
  }
  const PoseReport& shown = run.poses[poseToShow(run)];
  if (shown.verdict >= Verdict::unknown) {
    text << (run.count(Verdict::unknown) > 0 ? "Interference or unknown depth at " : "Interference at ")
         << listOf(interferingRanges(run)) << ", counted from 0\n";
    text << "Worst: pose " << poseToShow(run) << ", " << describeWorst(run, shown) << '\n';
  }
  if (run.job.continuous && run.motionCount() > 0) {
    writeMotionCounts(run, text);
    if (run.depthBound() > 0.0) text << "Depth between the poses: " << depthOnMotions(run) << '\n';
  }
  return text.str();
}

std::string depthOnMotions(const GrindingRun& run) {
  const std::size_t motions = run.motionCount(), proved = run.depthsProved();
  std::ostringstream text;
  text << "proved within the limit on " << proved << " of " << motions
       << (motions == 1 ? " motion" : " motions");
  if (proved == motions) return text.str();
  text << "; not proved on the others, but at most " << run.depthBound() << " mm";
  return text.str();
}

std::string partitionText(const BuildOptions& options) {
  if (options.partition == PartitionKind::clustering) return "clustered";
  const std::string k = options.clusters == 0 ? "k_opt" : "k = " + std::to_string(options.clusters);
  return "paper, " + k + ", FNOP " + std::to_string(options.leaf_capacity);
}

}  // namespace octoblisk::demos
